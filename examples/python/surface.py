"""A surface of NumPy's numbers, rendered while its colour and the camera change: surface.py OUT.png

Cells between the lines of `# %%` are a notebook's.
"""

# %% A surface z = f(x, y) as a mesh
import sys

import celltrace
import numpy as np

n = 120
x, z = np.meshgrid(np.linspace(-4, 4, n), np.linspace(-4, 4, n), indexing="ij")
y = np.cos(2 * np.hypot(x, z)) * np.exp(-0.25 * np.hypot(x, z))
vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)

corner = np.arange(n * n).reshape(n, n)
a, b, c, d = (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:])
triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)

slope_x, slope_z = np.gradient(y, x[:, 0], z[0])
normals = np.stack([-slope_x, np.ones_like(y), -slope_z], axis=-1).reshape(-1, 3)

# %% A scene around it
scene = celltrace.Scene()
scene.background = (0.05, 0.07, 0.1)
scene.add_light(celltrace.Light((6, 9, -4), area=celltrace.LightArea((2, 0, 0), (0, 0, 2), 8, 8)))
surface = scene.add(celltrace.Mesh(vertices, triangles, normals=normals),
                    material=celltrace.Material(colour=(0.9, 0.5, 0.1), specular=0.5, roughness=0.02))
for i, angle in enumerate(np.linspace(0, 2 * np.pi, 7)[:-1]):
    scene.add(celltrace.Sphere((3.2 * np.cos(angle), 0.9, 3.2 * np.sin(angle)), 0.35),
              material=celltrace.Material(colour=(0.8, 0.85, 0.9), reflection_min=0.3, reflection_max=0.6))

# %% Four views by one session: only what changes is made anew
session = celltrace.Session(scene, width=320, height=240, antialiasing=celltrace.Antialiasing())
material = scene.objects[surface].material
views = []
for turn, colour in zip((20, 50, 80, 110), ((0.9, 0.5, 0.1), (0.2, 0.6, 0.3), (0.2, 0.4, 0.9), (0.7, 0.2, 0.5))):
    angle = np.radians(turn)
    session.set_camera(celltrace.Camera.look_at((8 * np.cos(angle), 4.5, -8 * np.sin(angle)), (0, -0.2, 0), angle=55))
    session.set_material(material, scene.materials[material].replace(colour=colour))
    views.append(session.render())
    statistics = session.statistics
    print(f"{statistics['rays']['total']:8d} rays in {1000 * statistics['seconds']['render']:6.1f} ms, "
          f"preparation: {statistics['accelerator']['preparation']}")

# %% One picture of the four
picture = np.vstack([np.hstack(views[:2]), np.hstack(views[2:])])
celltrace.save(sys.argv[1] if len(sys.argv) > 1 else "surface.png", picture)
