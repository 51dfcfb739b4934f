// A lathe: bed with two ways of rectangular section, headstock on six bolts, carriage with tool post, keepers below the ways and gibs
// beside them, tailstock on two bolts. x along the spindle, y across, z up.
Include "parts.geo";

// bed, its ways in three lengths: headstock, carriage, tailstock
v = newv; Box(v) = {0, 30, 0, 900, 180, 150};
more() = {};
For i In {0:1}
  y = 180*i;
  w = newv; Box(w) = {0, y, 150, 250, 60, 30}; more() += w;
  w = newv; Box(w) = {250, y, 150, 430, 60, 30}; more() += w;
  w = newv; Box(w) = {680, y, 150, 220, 60, 30}; more() += w;
  w = newv; Box(w) = {750*i, 30, -25, 150, 180, 25}; more() += w;  // feet
  For j In {0:2}                                                  // pads of the nuts below the overhang
    w = newv; Box(w) = {50 + 75*j, 3 + 210*i, 145, 24, 24, 5}; more() += w;
  EndFor
  w = newv; Box(w) = {760, 3 + 210*i, 145, 24, 24, 5}; more() += w;
EndFor
bed() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };

// headstock: foot, box, bore of the spindle, pads of the six bolts
v = newv; Box(v) = {20, 0, 180, 230, 60, 25};
w = newv; Box(w) = {20, 60, 180, 230, 120, 25}; more() = {w};
w = newv; Box(w) = {20, 180, 180, 230, 60, 25}; more() += w;
w = newv; Box(w) = {20, 45, 205, 215, 150, 140}; more() += w;
For i In {0:1}
  For j In {0:2}
    w = newv; Box(w) = {50 + 75*j, 3 + 210*i, 205, 24, 24, 5}; more() += w;
  EndFor
EndFor
head() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };
w = newv; Box(w) = {45, 75, 225, 165, 90, 90};
head() = BooleanDifference{ Volume{head()}; Delete; }{ Volume{w}; Delete; };

// carriage: saddle, tool post, aprons in front and behind (gibs), keepers below the ways
v = newv; Box(v) = {350, -25, 180, 240, 85, 45};
w = newv; Box(w) = {350, 60, 180, 240, 120, 45}; more() = {w};
w = newv; Box(w) = {350, 180, 180, 240, 85, 45}; more() += w;
w = newv; Box(w) = {440, 90, 225, 60, 60, 75}; more() += w;
w = newv; Box(w) = {350, -25, 125, 240, 25, 55}; more() += w;
w = newv; Box(w) = {350, 240, 125, 240, 25, 55}; more() += w;
w = newv; Box(w) = {350, 0, 125, 240, 25, 25}; more() += w;
w = newv; Box(w) = {350, 215, 125, 240, 25, 25}; more() += w;
carriage() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };

// tailstock: foot, body, pads of its two bolts
v = newv; Box(v) = {700, 0, 180, 150, 60, 25};
w = newv; Box(w) = {700, 60, 180, 150, 120, 25}; more() = {w};
w = newv; Box(w) = {700, 180, 180, 150, 60, 25}; more() += w;
w = newv; Box(w) = {700, 70, 205, 150, 100, 110}; more() += w;
For i In {0:1}
  w = newv; Box(w) = {760, 3 + 210*i, 205, 24, 24, 5}; more() += w;
EndFor
tail() = BooleanUnion{ Volume{v}; Delete; }{ Volume{more()}; Delete; };

solids() = bed(); edge = 90; Call Size;
solids() = head(); edge = 65; Call Size;
solids() = carriage(); edge = 45; Call Size;
solids() = tail(); edge = 60; Call Size;
Physical Volume("bed", 1) = bed();
Physical Volume("headstock", 2) = head();
Physical Volume("carriage", 3) = carriage();
Physical Volume("tailstock", 4) = tail();

solids() = bed();
box() = {0, 0, -25, 900, 240, -25}; mark = 20; Call Mark;          // feet
box() = {0, 0, 180, 250, 60, 180}; mark = 21; Call Mark;           // ways: headstock, front and rear
box() = {0, 180, 180, 250, 240, 180}; mark = 30; Call Mark;
box() = {250, 0, 180, 680, 60, 180}; mark = 22; Call Mark;         // carriage
box() = {250, 180, 180, 680, 240, 180}; mark = 23; Call Mark;
box() = {680, 0, 180, 900, 60, 180}; mark = 24; Call Mark;         // tailstock
box() = {680, 180, 180, 900, 240, 180}; mark = 34; Call Mark;
box() = {250, 0, 150, 680, 30, 150}; mark = 25; Call Mark;         // below: keepers
box() = {250, 210, 150, 680, 240, 150}; mark = 26; Call Mark;
box() = {250, 0, 150, 680, 0, 180}; mark = 27; Call Mark;          // beside: gibs
box() = {250, 240, 150, 680, 240, 180}; mark = 28; Call Mark;
box() = {900, 30, 0, 900, 210, 150}; mark = 29; Call Mark;         // end face: the lead screw
For i In {0:1}
  For j In {0:2}
    box() = {50 + 75*j, 3 + 210*i, 145, 74 + 75*j, 27 + 210*i, 145}; mark = 61 + 3*i + j; Call Mark;
  EndFor
  box() = {760, 3 + 210*i, 145, 784, 27 + 210*i, 145}; mark = 67 + i; Call Mark;
EndFor
solids() = head();
box() = {20, 0, 180, 250, 60, 180}; mark = 31; Call Mark;
box() = {20, 180, 180, 250, 240, 180}; mark = 33; Call Mark;
box() = {235, 45, 205, 235, 195, 345}; mark = 32; Call Mark;       // nose of the spindle
For i In {0:1}
  For j In {0:2}
    box() = {50 + 75*j, 3 + 210*i, 210, 74 + 75*j, 27 + 210*i, 210}; mark = 71 + 3*i + j; Call Mark;
  EndFor
EndFor
solids() = carriage();
box() = {350, -25, 180, 590, 60, 180}; mark = 41; Call Mark;       // on the ways
box() = {350, 180, 180, 590, 265, 180}; mark = 42; Call Mark;
box() = {350, 0, 150, 590, 25, 150}; mark = 43; Call Mark;
box() = {350, 215, 150, 590, 240, 150}; mark = 44; Call Mark;
box() = {350, 0, 125, 590, 0, 180}; mark = 45; Call Mark;
box() = {350, 240, 125, 590, 240, 180}; mark = 46; Call Mark;
box() = {440, 90, 300, 500, 150, 300}; mark = 47; Call Mark;       // tool post
box() = {350, -25, 125, 350, 0, 180}; mark = 48; Call Mark;        // apron: the nut
solids() = tail();
box() = {700, 0, 180, 850, 60, 180}; mark = 51; Call Mark;
box() = {700, 180, 180, 850, 240, 180}; mark = 53; Call Mark;
box() = {700, 70, 205, 700, 170, 315}; mark = 52; Call Mark;       // quill
For i In {0:1}
  box() = {760, 3 + 210*i, 210, 784, 27 + 210*i, 210}; mark = 77 + i; Call Mark;
EndFor
