// Three sheets of 4 mm, lapped twice, two bolts each: shells. Mean planes z = 0, 4, 0.
Include "parts.geo";
Mesh.RecombineAll = 1;
DefineConstant[ cell = 10 ];
// Sheet: rectangles of the lengths dx() from x on, five over the width of 60, at height z
Macro Sheet
  all() = {};
  For k In {0:#dx()-1}
    For n In {0:4}
      y = 12*n;
      f = news; Rectangle(f) = {x, y, z, dx(k), 12};
      all() += f;
    EndFor
    x = x + dx(k);
  EndFor
  sheet() = BooleanFragments{ Surface{all()}; Delete; }{};
Return
x = 0; z = 0; dx() = {20, 100, 14, 12, 14};
Call Sheet;
a() = sheet();
x = 120; z = 4; dx() = {14, 12, 14, 80, 14, 12, 14};
Call Sheet;
m() = sheet();
x = 240; z = 0; dx() = {14, 12, 14, 100, 20};
Call Sheet;
c() = sheet();
Transfinite Curve{:} = 2;
lines() = Abs(Boundary{ Surface{a(), m(), c()}; });
For k In {0:#lines()-1}
  b() = BoundingBox Curve{lines(k)};
  n = Ceil((b(3) - b(0) + b(4) - b(1))/(10*scale));
  Transfinite Curve{lines(k)} = n + 1;
EndFor
Transfinite Surface{:};
// 1, 2, 3: the sheets away from the laps; 4: clamped end; 5, 6: lap left, lower and upper; 7, 8: lap right; 11 to 14 lower, 15 to 18 upper patches; 9: pulled end
Macro Sort
  For k In {0:#sheet()-1}
    b() = BoundingBox Surface{sheet(k)};
    xm = (b(0) + b(3))/2; ym = (b(1) + b(4))/2;
    p = plain;
    If (xm < 20)
      p = 4;
    EndIf
    If (xm > 380 - 20)
      p = 9;
    EndIf
    If (xm > 120 && xm < 160)
      p = 5 + upper;
      If (xm > 134 && xm < 146 && (ym > 12 && ym < 24 || ym > 36 && ym < 48))
        p = 11 + 4*upper + (ym > 30);
      EndIf
    EndIf
    If (xm > 240 && xm < 280)
      p = 7 + upper;
      If (xm > 254 && xm < 266 && (ym > 12 && ym < 24 || ym > 36 && ym < 48))
        p = 13 + 4*upper + (ym > 30);
      EndIf
    EndIf
    shells() += {sheet(k)}; kinds() += {p};
  EndFor
Return
shells() = {}; kinds() = {};
sheet() = a(); plain = 1; upper = 0;
Call Sort;
sheet() = m(); plain = 2; upper = 1;
Call Sort;
sheet() = c(); plain = 3; upper = 0;
Call Sort;
For p In {1:18}
  found() = {};
  For k In {0:#shells()-1}
    If (kinds(k) == p)
      found() += shells(k);
    EndIf
  EndFor
  If (#found())
    Physical Surface(p) = found();
  EndIf
EndFor
