// expect: string-doubled.pov:4:16: error: this string is too long
#declare S = "0123456789";
#while (1)
  #declare S = concat(S, S);
#end
