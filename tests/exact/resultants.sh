# Force and moment of each joint, from the table of the listing, in equilibrium with what the bodies carry: loads on one side of it and
# the reactions of the supports there. The force is that of side 1 on side 2, the moment is about the centroid of the joint.

# balance NAME JOINT SIDE X Y FIRST LAST LOADS: the part with nodes FIRST to LAST lies on SIDE of the joint, centroid X, Y;
# LOADS: lines `stage node fx fy`, the load at the end of the stage. Six digits are printed.
balance() {
   judge "$1: resultants of joint $2 against loads and reactions on side $3" -v joint="$2" -v side="$3" -v x0="$4" -v y0="$5" \
      -v first="$6" -v last="$7" -v loads="$8" '
      function add(s, node, fx, fy) {
         px[s] += fx; py[s] += fy
         # to the moment of single forces the digits of the table are not enough without their size
         mz[s] += (x[node] - x0) * fy - (y[node] - y0) * fx
         size[s] += (fx < 0 ? -fx : fx) + (fy < 0 ? -fy : fy)
         d = sqrt((x[node] - x0)^2 + (y[node] - y0)^2); if (d > far) far = d
      }
      function stage_of(line) { sub(/.*STAGE /, "", line); return line + 0 }
      / RESULTANTS OF JOINTS/ { table = "joints"; s = stage_of($0); next }
      / DISPLACEMENTS OF NODES/ { table = "nodes"; next }
      / REACTIONS/ { table = "reactions"; s = stage_of($0); next }
      / [A-Z]+ OF |STRESSES|BALANCE|ENERGY|INTERFACE|SHEAR IN/ && !/NODE|JOINT +NORMAL/ { table = "" }
      table == "joints" && NF == 7 && $2 == joint { fx[s] = $5; fy[s] = $6; m[s] = $7; stages = s }
      table == "nodes" && NF == 5 { x[$1] = $2; y[$1] = $3 }
      table == "reactions" && NF >= 3 && $1 ~ /^[0-9]+$/ && $1 >= first && $1 <= last { n++; r[n] = s " " $1 " " $(NF - 1) " " $NF }
      END {
         k = split(loads, lines, ";")
         for (i = 1; i <= k; i++) { split(lines[i], v, " "); add(v[1], v[2], v[3], v[4]) }
         for (i = 1; i <= n; i++) { split(r[i], v, " "); add(v[1], v[2], v[3], v[4]) }
         sign = side == 1 ? 1 : -1          # on side 1 acts the opposite of what the joint hands to side 2
         for (s = 1; s <= stages; s++) {
            e = px[s] - sign * fx[s]; f = py[s] - sign * fy[s]; g = mz[s] - sign * m[s]
            t = 3e-6 * size[s]
            if (e * e > t * t || f * f > t * t || g * g > t * t * far * far || size[s] == 0)
               print "stage " s ": " px[s], py[s], mz[s] " against " sign * fx[s], sign * fy[s], sign * m[s]
         }
         print "checked " stages
      }' "$work/$1.out"
}

# the upper plate of the lap joint: clamped from above, pulled and guided at its right end
run_input lap_joint && {
   clamp() { echo "$1 209 0 -200;$1 215 0 -400;$1 221 0 -200"; }
   balance lap_joint 1 2 80 10 201 399 "$(clamp 1);$(clamp 2);2 319 25 0;2 320 50 0;2 321 25 0;$(clamp 3)"
   balance lap_joint 1 1 80 10 1 199 "1 107 0 200;1 113 0 400;1 119 0 200;2 107 0 200;2 113 0 400;2 119 0 200;3 107 0 200;3 113 0 400;3 119 0 200"
}

# the whole cantilever stands on its joint
run_input cantilever && {
   loads=
   for stage in 1 2 3 4 5; do
      for node in 5 10 210 215; do loads="$loads$stage $node 0 -500;"; done
   done
   balance cantilever 1 1 0 0 1 999 "${loads}2 375 60 0;4 375 -60 0"
}

# the upper part of the column at 30 degrees; by hand: normal force 600 cos 30, shear force 600 sin 30
run_input joint30 && {
   loads='1 105 0 -50;1 110 0 -100;1 115 0 -100;1 120 0 -100;1 125 0 -100;1 130 0 -100;1 135 0 -50'
   balance joint30 1 2 30 57.32050808 0 0 "$loads"
   read -r n_elements normal shear <<< "$(awk '/RESULTANTS/ { on = 1 } /ENERGY/ { on = 0 } on && NF == 7 && $1 == 5 { r = $3 " " $4 } / INTERFACE ELEMENTS   / { n = $3 } END { print n, r }' "$work/joint30.out")"
   near 'joint30: normal force' "$normal" 519.6152 2e-6
   near 'joint30: shear force' "${shear#-}" 300 4e-6
   same 'joint30: interface elements' "$n_elements" 7
   ask 'joint30: force along every element is normal and shear turned by 30 degrees' joint30 rows 'increment = 5' all \
      'sum(force) = 519.61524227 within 1e-5 and abs(sum(tau_x*area)) = 300 within 1e-5 and sum(area) = 1200/cos(pi/6) within 1e-4'
}

# seven elements over five: the upper block pressed evenly, then pushed and pulled along its top
run_input meshed_apart && {
   along_top() { # STAGE FORCE: the top with its pressure, and this force
      for node in 103 106 109 112 115 118 121 124; do
         share=2; [ $node -gt 103 ] && [ $node -lt 124 ] || share=1
         awk -v n=$node -v s="$1" -v f="$2" -v share=$share 'BEGIN { printf "%d %d %.9f %.9f;", s, n, f*share/14, -100*share/14 }'
      done
   }
   balance meshed_apart 1 1 25 20 101 199 "$(along_top 1 0)$(along_top 2 20)$(along_top 3 0)$(along_top 4 -24)0 0 0 0"
}
