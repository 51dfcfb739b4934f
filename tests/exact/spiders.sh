# Bolts from spider to spider and a load on a rigid pin, input/bracket_spiders.bdf: statics of the foot, from the histories of bolts and joint.

run_input bracket_spiders && {
   ask 'tightened, the joint carries the preloads' bracket_spiders rows 'stage = 1' by increment all 'sum(force) = 48000*load within 1e-5'
   judge 'foot of the bracket: forces along z, moments about y' -F, '
      FNR == 1 { file++; for (i = 1; i <= NF; i++) at[file, $i] = i; next }
      { step = $at[file, "stage"] "," $at[file, "increment"]; share[step] = $at[file, "stage"] == 2 ? $at[file, "load"] : $at[file, "stage"] == 3 }
      file == 1 { arm = $at[1, "bolt"] % 2 ? -30 : 30; n[step] -= $at[1, "force"]; m[step] += arm * $at[1, "force"] }
      file == 2 { n[step] += $at[2, "force"]; m[step] -= ($at[2, "x"] - 50) * $at[2, "force"] }
      END {
         for (step in n) {
            off = n[step] + 600 * share[step]; turn = m[step] + (3000 * 80 + 20000) * share[step]
            if (!(off < 1e-4 && off > -1e-4 && turn < 1e-2 && turn > -1e-2)) print step ": left over " off ", " turn
            checked++
         }
         if (checked == 12) print "checked " checked
      }' "$work/bracket_spiders.bolt.csv" "$work/bracket_spiders.joint.csv"
   sed 's/^SPC = 1/SPC = 1\nSOLVER = SKYLINE/' input/bracket_spiders.bdf > "$work/bracket_skyline.bdf"
   run bracket_skyline && same_rows 'bracket by SKYLINE' bracket_spiders bracket_skyline 1e-9 $both
}
