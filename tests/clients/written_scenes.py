"""Scenes and INI files of the kinds that programs write, for their command lines."""

import math
import os

MOLECULE = """#include "colors.inc"
#include "finish.inc"
global_settings { assumed_gamma 1 max_trace_level 6 }
background { color White }
camera { orthographic right -6.00*x up 4.50*y direction 1.00*z location <0, 0, 50.00> look_at <0, 0, 0> }
light_source { <2.00, 3.00, 40.00> color White }
#declare simple = finish { phong 0.7 }
#declare ase3 = finish { ambient 0.15 brilliance 2 diffuse 0.6 metallic specular 1.0 roughness 0.001 reflection 0.0 }
#macro atom(LOC, R, COL, TRANS, FIN)
  sphere { LOC, R texture { pigment { color COL transmit TRANS } finish { FIN } } }
#end
atom(<-1.20, 0.00, -0.50>, 1.10, rgb <0.50, 0.50, 0.50>, 0.0, ase3) // #0
atom(< 1.20, 0.40, -0.20>, 0.90, rgb <1.00, 0.05, 0.05>, 0.3, simple) // #1
cylinder { <-1.20, 0.00, -0.50>, <1.20, 0.40, -0.20>, 0.2 texture { pigment { color rgb <0.8, 0.8, 0.2> } finish { ase3 } } }
"""

BRICKS = """#include "colors.inc"
#declare lc_red = texture { pigment { rgb <0.8, 0.1, 0.1> } finish { ambient 0.1 phong 0.2 phong_size 20 } }
#declare lc_clear = texture { pigment { rgb <0.6, 0.8, 0.9> filter 0.9 } finish { ambient 0.3 diffuse 0.2 reflection 0.25 phong 0.3 phong_size 60 } }
#declare lc_part = union {
  mesh {
    triangle { <-1, -1.1, 0>, <1, -1.1, 0>, <1, -1.1, 0.5> texture { lc_red } }
    triangle { <-1, -1.1, 0>, <1, -1.1, 0.5>, <-1, -1.1, 0.5> texture { lc_red } }
  }
  box { <-1, -1, 0>, <1, 1, 0.6> }
  cylinder { <0.5, 0.5, 0.5>, <0.5, 0.5, 0.8>, 0.3 }
  cylinder { <-0.5, -0.5, 0.5>, <-0.5, -0.5, 0.8>, 0.3 }
}
#declare lc_part_clear = lc_part
camera { sky <0, 0, 1> location <5, -4, 4> look_at <0, 0, 0.5> angle 38 }
background { color rgb <0.9, 0.95, 1> }
light_source { <0, 0, 20> White shadowless }
light_source { <20, -10, 15> color rgb 0.6 }
object { lc_part texture { lc_red } matrix <1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0> }
object { lc_part_clear texture { lc_clear } matrix <0, -1, 0, 1, 0, 0, 0, 0, 1, 0.4, 0.3 + 0.2 * clock, 0.85> }
"""

VMD_HEAD = """//
// Molecular graphics export
// try povray +W120 +H90 -Ivmdscene.pov -Ovmdscene.pov.tga +P +X +A +FT +C
#if (version < 3.5)
#error "needs POV-Ray 3.5 or above.\\nPlease upgrade POV-Ray."
#end
#declare VMD_clip_on=array[3] {0, 0, 0};
#declare VMD_clip=array[3];
#declare VMD_scaledclip=array[3];
#declare VMD_line_width=0.0020;
#macro VMDC ( C1 )
  texture { pigment { rgbt C1 }}
#end
#macro VMD_sphere (P1, R1, C1)
  #local T = texture { pigment { C1 } }
  #if(VMD_clip_on[2])
  intersection {
    sphere {P1, R1 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
    VMD_clip[2]
  }
  #else
  sphere {P1, R1 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
  #end
#end
#macro VMD_cylinder (P1, P2, R1, C1, O1)
  #local T = texture { pigment { C1 } }
  cylinder {P1, P2, R1 #if(O1) open #end texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
#end
#macro VMD_triangle (P1, P2, P3, N1, N2, N3, C1)
  #local T = texture { pigment { C1 } }
  smooth_triangle {P1, N1, P2, N2, P3, N3 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
#end
#macro VMD_tricolor (P1, P2, P3, N1, N2, N3, C1, C2, C3)
  #local NX = P2-P1;
  #local NY = P3-P1;
  #local NZ = vcross(NX, NY);
  #local T = texture { pigment {
    average pigment_map {
      [1 gradient x color_map {[0 rgb 0] [1 C2*3]}]
      [1 gradient y color_map {[0 rgb 0] [1 C3*3]}]
      [1 gradient z color_map {[0 rgb 0] [1 C1*3]}]
    }
    matrix <1.01,0,1,0,1.01,1,0,0,1,-.002,-.002,-1>
    matrix <NX.x,NX.y,NX.z,NY.x,NY.y,NY.z,NZ.x,NZ.y,NZ.z,P1.x,P1.y,P1.z>
  } }
  smooth_triangle {P1, N1, P2, N2, P3, N3 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
#end
camera {
  orthographic
  location <0.0000, 0.0000, -2.0000>
  look_at <-0.0000, -0.0000, 2.0000>
  up <0.0000, 3.0000, 0.0000>
  right <4.0000, 0.0000, 0.0000>
}
light_source {
  <-0.1000, 0.1000, -1.0000>
  color rgb<1.000, 1.000, 1.000>
  parallel
  point_at <0.0, 0.0, 0.0>
}
background {
  color rgb<0.000, 0.000, 0.000>
}
"""

VMD_DEFAULT = """#default { texture {
 finish { ambient 0.000 diffuse 0.650 phong 0.1 phong_size 40.000 specular 0.500 }
} }
"""

# Odd numbers, as molecules have: where a silhouette runs exactly through samples, any rounding decides.
VMD_ATOMS = """VMD_sphere(<-0.8137,0.1073,-0.2019>,0.3971,rgbt<0.250,0.750,0.750,0.000>)
VMD_sphere(<0.6043,0.3089,0.0000>,0.3013,rgbt<1.000,0.000,0.000,0.300>)
VMD_cylinder(<-0.8137,0.1073,-0.2019>,<0.6043,0.3089,-0>0.1000,rgbt<0.250,0.250,0.750,0.000>,1)
VMD_triangle(<-1.5127,-1.0171,0.1>,<0.0113,-1.2081,0>,<-0.7079,-0.4129,-0.2>,<0.1,0.1,-1>,<0,0.2,-1>,<-0.1,0,-1>,rgbt<0.750,0.750,0.250,0.000>)
VMD_tricolor(<0.2117,-1.0237,0.1>,<1.7091,-1.2173,0>,<1.1039,-0.2161,-0.2>,<0.1,0.1,-1>,<0,0.2,-1>,<-0.1,0,-1>,rgbt<1.000,0.100,0.100,0.000>,"""\
    """rgbt<0.100,1.000,0.100,0.000>,rgbt<0.100,0.100,1.000,0.000>)
// End of POV-Ray 3.x generation
"""


def vmd_mesh(cells=8):
    """A wavy surface with a colour at each vertex, a thousand times as large and scaled back, in fog."""
    side = cells + 1
    grid = [(2.4 * i / cells - 1.2, 1.6 * j / cells - 0.8) for j in range(side) for i in range(side)]
    height = [0.2 * math.sin(3 * x) * math.cos(4 * y) for x, y in grid]
    vertices = "".join(f"  <{1000 * x:.4f},{1000 * y:.4f},{1000 * z:.4f}>,\n" for (x, y), z in zip(grid, height))
    normals = "".join(f"  <{0.6 * math.cos(3 * x) * math.cos(4 * y):.4f},{-0.8 * math.sin(3 * x) * math.sin(4 * y):.4f},-1.0000>,\n"
                      for x, y in grid)
    colours = "".join(f"  VMDC(<{(x + 1.2) / 2.4:.3f},{(y + 0.8) / 1.6:.3f},0.500,0.000>)\n" for x, y in grid)
    corners = [(j * side + i, j * side + i + 1, (j + k) * side + i + 1 - k, k) for j in range(cells) for i in range(cells) for k in (1,)]
    faces = []
    for a, b, _, _ in corners:
        for face in ((a, b, a + side), (b, b + side, a + side)):
            faces.append(f"  <{face[0]},{face[1]},{face[2]}>,{face[0]},{face[1]},{face[2]}\n")
    count = len(grid)
    return (f"mesh2 {{\n  vertex_vectors {{\n  {count},\n{vertices}  }}\n  normal_vectors {{\n  {count},\n{normals}  }}\n"
            f"  texture_list {{\n  {count},\n{colours}  }}\n  face_indices {{\n  {len(faces)}\n{''.join(faces)}  }}\n"
            "  inside_vector <0, 0, 1>\n  no_shadow\nmatrix < \n  0.001000, 0.000000, 0.000000,\n  0.000000, 0.001000, 0.000000,\n"
            "  0.000000, 0.000000, 0.001000,\n  0.000000, 0.000000, 0.000000 \n> }\n")


VMD_FOG = "fog {\n  distance 3.1250 \n  fog_type 1 \n  color rgb<0.000, 0.000, 0.000> \n} \n"

INIS = {
    "ase.ini": """Input_File_Name=ase.pov
Output_to_File=True
Output_File_Type=N
Output_Alpha=on
; if you adjust Height, and width, you must preserve the ratio
; Width / Height = 1.333333
Width=120.6
Height=90.45045045045045
Antialias=True
Antialias_Threshold=0.1
Display=False
Pause_When_Done=True
Verbose=False
""",
    "canvas.ini": """Input_File_Name=molecule.pov
Output_to_File=True
Output_File_Type=N
Output_Alpha=False
Output_File_Name=canvas.png
Width=120
Height=90
Antialias=True
Antialias_Threshold=0.1
Display=False
Pause_When_Done=True
Verbose=False
""",
    "jmol.pov.ini": """; Created by: a program  14.32
; Creation date: Mon, 30 Nov 2026 11:18:05 +0000


; state: (embedded in input file)
Input_File_Name=molecule.pov
Output_to_File=true
Output_File_Type=N
Output_File_Name=jmol.pov.png
Width=120
Height=90
Antialias=true
Antialias_Threshold=0.1
Display=true
Pause_When_Done=true
Warning_Level=5
Verbose=false
""",
    "blender.ini": """Version=3.7
All_File=1
Input_File_Name='{folder}/bricks.pov'
Output_File_Name='{folder}/out.png'
Width=120
Height=90
Bounding_Method=2
Display=1
Pause_When_Done=0
Output_File_Type=N
Output_Alpha=1
Antialias=on
Antialias_Depth=2
Antialias_Threshold=0.03
Sampling_Method=2
Antialias_Gamma=2.5
Jitter=on
Jitter_Amount=  1
""",
    "border.ini": """Version=3.7
All_File=1
Input_File_Name='{folder}/bricks.pov'
Output_File_Name='{folder}/out.png'
Width=120
Height=90
Start_Column= 0.2
End_Column=0.75
Start_Row= 0.1
End_Row= 0.9
Bounding_Method=2
Display=1
Pause_When_Done=0
Output_File_Type=N
Output_Alpha=1
Antialias=off
""",
    "preview.ini": """Version=3.7
Input_File_Name="{folder}/bricks.pov"
Output_File_Name="{folder}/prev.png"
Library_Path="{folder}"
Width=96
Height=96
Pause_When_Done=0
Output_File_Type=N
Output_Alpha=1
Antialias=on
Sampling_Method=2
Antialias_Depth=3
-d
""",
    "maker.ini": """;POV-Ray ini file made by a script
Antialias=On
Antialias_Threshold=0.1
Antialias_Depth=2
Width =120;
Height =90;
Input_File_Name="bricks.pov"
Output_File_Name="maker.png"
Cyclic_Animation=on
Pause_when_Done=off    
Test_Abort_Count=100
""",
    "quick.ini": """;; Library_Path="/usr/local/tools/povray/share/povray-3.6"
Output_File_Type=n
Verbose=On
Pause_when_done=Off
Start_Row=0.0
End_Row=1.0
Video_Mode=1

;; Display=Off
Antialias=On
Antialias_Threshold=0.99
Sampling_Method=2
Declare=Shadows=1
""",
    "movie.ini": """Input_File_Name=bricks.pov
Output_File_Name=movie-
Output_to_File=On
Pause_When_Done=Off
Verbose=Off
Display=On
Width=720
Width=480
+FN
+a +j0
+L../../includes

Initial_Clock=0
Final_Clock=3
Final_Frame=3

[LOW]
Width=120
Height=90

[HIGH]
Width=1920
Height=1080
""",
    "move.ini": """Library_Path=c:\\povray\\include
Input_File_Name=bricks.pov
Output_File_Name=move
Initial_Frame=0
Initial_Clock=0
Final_Clock=1
Cyclic_Animation=off
Post_Frame_Command=arj m smove.arj %o
Post_Frame_Return=I
+v
-p
+w64
+h48
+a0.01
-j0
[go]
Final_Frame=2
""",
    "life.ini": """Initial_Frame=0
Final_Frame=2
Subset_Start_Frame=0
Subset_End_Frame=2
Input_File_Name=bricks.pov
Output_File_Name=life

Cyclic_animation=On
Pause_when_Done=Off
Output_File_Type=B

Sampling_Method=1
Antialias_Threshold=0.5
Antialias_Depth=2
Jitter=Off
Test_Abort_Count=100
""",
    "bench.ini": """All_Console=On
All_File=
Antialias_Depth=3
Antialias=On
Antialias_Gamma=2.5
Antialias_Threshold=0.3
Bits_Per_Color=8
Bounding=On
Bounding_Method=1
Bounding_Threshold=3
Clock=0
Continue_Trace=Off
Clockless_Animation=off
Cyclic_Animation=Off
Debug_Console=On
Debug_File=
Display=Off
Fatal_Console=On
Fatal_Error_Command=
Fatal_Error_Return=I
Fatal_File=
Input_File_Name=bricks.pov
Jitter_Amount=0.3
Jitter=Off
Light_Buffer=On
Odd_Field=Off
Output_Alpha=Off
Output_File_Name=
Output_File_Type=n
Output_To_File=On
Palette=3
Pause_When_Done=Off
Post_Frame_Command=
Post_Frame_Return=I
Post_Scene_Command=
Post_Scene_Return=I
Preview_End_Size=1
Preview_Start_Size=1
Pre_Frame_Command=
Pre_Frame_Return=I
Quality=9
Remove_Bounds=On
Render_Console=On
Render_File=
Sampling_Method=1
Split_Unions=Off
Statistic_Console=On
Statistic_File=
Test_Abort_Count=0
Test_Abort=On
User_Abort_Command=
User_Abort_Return=I
Verbose=On
Version=3.7
Video_Mode=0
Vista_Buffer=Off
Warning_Console=On
Warning_File=
""",
}


def write(folder):
    """Writes all scenes and INI files into a folder."""
    files = dict(INIS)
    files.update({"molecule.pov": MOLECULE, "ase.pov": MOLECULE, "bricks.pov": BRICKS,
                  "vmdscene.pov": VMD_HEAD + VMD_DEFAULT + VMD_ATOMS,
                  "vmdmesh.pov": VMD_HEAD + VMD_FOG + VMD_DEFAULT + vmd_mesh()})
    for name, text in files.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text.replace("{folder}", os.path.abspath(folder)))
