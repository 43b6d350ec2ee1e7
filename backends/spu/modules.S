# Fetches code modules: the linker's stubs for calls into overlays branch to this code.
#
# The linker makes _ovly_table (for each overlay, from number 1 on: address, bytes, offset in the program's
# file, number of its region from 1 on) and _ovly_buf_table (for each region: number of the present overlay).
# A stub puts the overlay's number into $78 and the function's address into $79. The registers $75 to $79 are
# free here; the caller's return address stays valid, because only resident code calls modules.
#
# A fetch consists of DMA commands of at most 16 KB with the tag TAG, and a wait. The program's file must not
# cross a boundary of 4 GB.

  .set TAG, 31

  .text
  .align 4
  .global __ovly_load
  .type __ovly_load, @function
__ovly_load:
  # Is the module in its region already?
  shli    $77, $78, 4
  ila     $76, _ovly_table - 16
  lqx     $77, $77, $76
  rotqbyi $76, $77, 12
  shli    $76, $76, 2
  ila     $75, _ovly_buf_table - 4
  a       $75, $75, $76
  lqd     $76, 0($75)
  rotqby  $76, $76, $75
  ceq     $76, $76, $78
  brnz    $76, .Lthere
  # Note that the region now holds the module.
  lqd     $77, 0($75)
  cwd     $76, 0($75)
  shufb   $77, $78, $77, $76
  stqd    $77, 0($75)
  shli    $77, $78, 4
  ila     $76, _ovly_table - 16
  lqx     $77, $77, $76
  # Compute the module's effective address, that of the program's file plus the offset: $79 is its high word,
  # $78 its low word. $77 is the local-store address, $75 the number of bytes.
  stqr    $79, .Ltarget
  rotqbyi $75, $77, 8
  lqr     $76, celltrace_program_image
  rotqbyi $76, $76, 4
  a       $78, $75, $76
  cg      $75, $75, $76
  rotqbyi $76, $76, 12
  a       $79, $75, $76
  rotqbyi $75, $77, 4
  ai      $75, $75, 15
  andi    $75, $75, -16
.Lpiece:
  wrch    $ch16, $77
  wrch    $ch17, $79
  wrch    $ch18, $78
  rotmi   $76, $75, -14
  brz     $76, .Llast
  ila     $76, 16384
  wrch    $ch19, $76
  a       $77, $77, $76
  a       $78, $78, $76
  sf      $75, $76, $75
  il      $76, TAG
  wrch    $ch20, $76
  il      $76, 0x40
  wrch    $ch21, $76
  brnz    $75, .Lpiece
  br      .Lwait
.Llast:
  wrch    $ch19, $75
  il      $76, TAG
  wrch    $ch20, $76
  il      $76, 0x40
  wrch    $ch21, $76
.Lwait:
  ilhu    $76, 0x8000
  wrch    $ch22, $76
  il      $76, 2
  wrch    $ch23, $76
  rdch    $76, $ch24
  sync
  lqr     $79, .Ltarget
.Lthere:
  bi      $79
  .size __ovly_load, . - __ovly_load

# The linker needs this symbol if functions of modules call other modules. It just returns, because only
# resident code calls modules here.
  .global __ovly_return
  .type __ovly_return, @function
__ovly_return:
  bi      $0
  .size __ovly_return, . - __ovly_return

  .section .bss.modules, "aw", @nobits
  .align 4
.Ltarget:
  .space 16
