"""Ray-traces POV-Ray scenes.

    pixels = celltrace.render("scene.pov", width=640, height=480)   # NumPy: (480, 640, 4), uint8
    celltrace.save("scene.png", pixels)
"""

from celltrace import _celltrace
from celltrace._celltrace import *
from celltrace._celltrace import __version__
from celltrace._camera import fit as _fit
from celltrace._colours import srgb
from celltrace._picture import Picture
from celltrace._surface import surface

Camera.fit = staticmethod(_fit)
__all__ = [*_celltrace.__all__, "Picture", "srgb", "surface"]
for _made in (Picture, srgb, surface):
    _made.__module__ = "celltrace"
