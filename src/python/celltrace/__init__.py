"""Ray-traces POV-Ray scenes.

    pixels = celltrace.render("scene.pov", width=640, height=480)   # NumPy: (480, 640, 4), uint8
    celltrace.save("scene.png", pixels)
"""

from celltrace._celltrace import *
from celltrace._celltrace import __all__
