// expect: bad-utf8.pov:3:1: error: unexpected character 0xC3, expected an object, the camera or a directive
sphere { 0, 1 }
Ã( ÿþ
