// expect: write-outside.pov:3:10: error: file '/etc/celltrace-was-here': it lies outside of the folders that --allow-write lets scenes write in
// arguments: --allow-write .
#fopen F "/etc/celltrace-was-here" write
