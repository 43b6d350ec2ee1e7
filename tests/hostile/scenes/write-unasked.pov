// expect: write-unasked.pov:2:10: error: file 'written.txt': scenes write no files unless --allow-write DIR says in which folder they may
#fopen F "written.txt" write
