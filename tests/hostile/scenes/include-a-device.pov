// expect: include-a-device.pov:2:10: error: cannot find the include file '/dev/zero'
#include "/dev/zero"
