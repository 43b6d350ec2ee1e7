// expect: read-outside.pov:2:10: error: file '/etc/passwd' lies outside of the scene's folder and the library path: --allow DIR lets the scene read what is in a folder
#fopen F "/etc/passwd" read
#read (F, A)
