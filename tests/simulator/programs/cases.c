// What `celltrace spu` has to cope with, by name: cases.elf NAME [VALUE]. Linked with -mstdmain.
#include <spu_intrinsics.h>
#include <spu_mfcio.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int echo(int argc, char** argv) {
  int i;
  for (i = 0; i < argc; ++i)
    printf("%d: %s\n", i, argv[i]);
  return argv[argc] == NULL ? 0 : 99;
}

static int copy_input(void) {
  int character;
  while ((character = getchar()) != EOF)
    putchar(character);
  return 0;
}

static int write_file(const char* name) {
  FILE* file = fopen(name, "w");
  if (file == NULL) {
    perror(name);
    return 3;
  }
  fputs("written\n", file);
  return fclose(file);
}

static int get_too_much(void) {
  static char buffer[128] __attribute__((aligned(128)));
  mfc_get(buffer, 0x100000, 100, 0, 0, 0);
  return 0;
}

static int recurse(int depth) {
  volatile char frame[1024];
  frame[depth & 1023] = 1;
  return recurse(depth + 1) + frame[0];
}

int main(int argc, char** argv) {
  const char* name = argc > 1 ? argv[1] : "";
  const char* value = argc > 2 ? argv[2] : "";
  if (strcmp(name, "echo") == 0) return echo(argc, argv);
  if (strcmp(name, "exit") == 0) return atoi(value);
  if (strcmp(name, "cat") == 0) return copy_input();
  if (strcmp(name, "write") == 0) return write_file(value);
  if (strcmp(name, "dma") == 0) return get_too_much();
  if (strcmp(name, "mailbox") == 0) return (int)spu_read_in_mbox();
  if (strcmp(name, "stop") == 0) spu_stop(0x1234);
  if (strcmp(name, "invalid") == 0) asm volatile(".long 0x00800000");
  if (strcmp(name, "recurse") == 0) return recurse(0);
  if (strcmp(name, "warn") == 0) spu_mfcstat(MFC_TAG_UPDATE_IMMEDIATE), mfc_write_tag_update_immediate();
  if (strcmp(name, "abort") == 0) abort();
  while (strcmp(name, "spin") == 0)
    asm volatile("");
  if (strcmp(name, "messages") == 0) {
    fputs("to the output\n", stdout);
    fputs("to the errors\n", stderr);
  }
  return 0;
}
