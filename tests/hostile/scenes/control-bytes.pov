// expect: control-bytes.pov:3:1: error: unexpected character 0x01, expected an object, the camera or a directive
sphere { 0, 1 }
