// expect: write-above.pov:3:10: error: file '../celltrace-was-here': it lies outside of the folders that --allow-write lets scenes write in
// arguments: --allow-write .
#fopen F "../celltrace-was-here" append
