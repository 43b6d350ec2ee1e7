// expect: list-without-end.pov:3:47: error: this list has more than 100000 entries (--max list-entries=N allows more)
// arguments: --max list-entries=100000
mesh2 { vertex_vectors { 3 #for (I, 1, 1e6) , I * x #end } }
