// expect: include-above.pov:2:10: error: include file '../../../../../../../../../../../../etc/passwd' lies outside of the scene's folder and the library path: --allow DIR lets the scene read what is in a folder
#include "../../../../../../../../../../../../etc/passwd"
