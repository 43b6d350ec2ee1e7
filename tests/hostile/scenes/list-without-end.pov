// expect: list-without-end.pov:3:41: error: this list has more than 100000 entries (--max list-entries=N allows more)
// arguments: --max list-entries=100000
mesh2 { vertex_vectors { 3 #while (1) , x #end } }
