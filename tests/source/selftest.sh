#!/usr/bin/env bash
# Tests the tools of make mutants and make coverage on a source and results written here; nothing is built.
set -u
shopt -s lastpipe
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
passed=0 failed=0
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2

# same WHAT EXPECTED: the standard input is EXPECTED
same() {
   local is
   is=$(cat)
   if [ "$is" = "$2" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); diff <(echo "$2") <(echo "$is"); echo "FAILED $1"; fi
}

# ---- the changes of a source ----

mkdir -p src/solver src/run
cat > src/solver/subject.f90 <<'END'
module subject
   integer, parameter :: outside = 3
contains
   !> 1 + 2 in a comment
   subroutine work(a, n)
      integer, intent(in) :: n(2)
      real(wp) :: a(3, 3)
      real(wp), parameter :: half = 0.5_wp
      if (a(i, j) <= 1.0e-4_wp .and. .not. done) then
         call say('1 + 2', x2%k)  ! 7
      end if
      do i = 1, n
         b = -c*d**2 + &
             real64/4
      end do
   end subroutine work
end module subject
END
printf 'contains\n do i = 1, size(n)\n do concurrent (k = 1:size(n))\n' > loops.f90
awk -v seed=1 -f "$here/mutate.awk" loops.f90 | cut -f 4,6 | grep bound | sort | same 'the bound of a loop, whole' "bound of a loop	 do concurrent (k = 1:size(n) - 1)
bound of a loop	 do i = 1, size(n) - 1"
# mutants [OPTION...]: line, what is done, and the line as it becomes
mutants() { awk -v seed=1 "$@" -f "$here/mutate.awk" src/*/*.f90 | cut -f 3,4,6 | sed "s/$(printf "\\t") */: /g" | sort; }
mutants | same 'every single change, and no other' "10: call left out: continue  ! 7
12: bound of a loop: do i = 1, n - 1
12: constant: do i = 2, n
13: constant: b = -c*d**3 + &
13: plus, minus: b = -c*d**2 - &
13: sign of a term: b = c*d**2 + &
13: times, divide: b = -c*d*2 + &
13: times, divide: b = -c/d**2 + &
14: constant: real64/5
14: times, divide: real64*4
8: constant: real(wp), parameter :: half = 0.25_wp
9: and, or: if (a(i, j) <= 1.0e-4_wp .or. .not. done) then
9: bound of a comparison: if (a(i, j) < 1.0e-4_wp .and. .not. done) then
9: condition: if (.not. (a(i, j) <= 1.0e-4_wp .and. .not. done)) then
9: constant: if (a(i, j) <= (0.5_wp*1.0e-4_wp) .and. .not. done) then
9: indices: if (a(j, i) <= 1.0e-4_wp .and. .not. done) then
9: not: if (a(i, j) <= 1.0e-4_wp .and. done) then"

# ---- the draw ----

draw() { awk "$@" -f "$here/mutate.awk" src/*/*.f90 | sort -n | cut -f 1,6; }
draw -v seed=1 > first
draw -v seed=1 | same 'the same seed, the same draw' "$(cat first)"
[ "$(draw -v seed=2 | cut -f 2)" != "$(cut -f 2 first)" ]; echo $? | same 'another seed, another draw' 0
for other in mawk gawk busybox; do
   command -v $other > /dev/null || continue
   [ $other = busybox ] && other='busybox awk'
   $other -v seed=1 -f "$here/mutate.awk" src/*/*.f90 | sort -n | cut -f 1,6 | same "$other: the same draw" "$(cat first)"
done
sed -i 's/^         b = -c\*d/         bb = -c*d/' src/solver/subject.f90
draw -v seed=1 | grep -v 'bb =' | same 'what is written elsewhere leaves a line its place in the draw' "$(grep -v 'b = ' first)"
echo 'src/solver/subject.f90 | do i = 1, n | do i = 1, n - 1 | the last one is idle' > equivalent
draw -v seed=1 -v equivalent=equivalent | grep -c 'n - 1' | same 'an equivalent change leaves the draw' 0
echo 'src/solver/subject.f90 | do i = 1, n | why not' > equivalent
draw -v seed=1 -v equivalent=equivalent 2>&1 | same 'a line of equivalent.txt without a reason' 'equivalent: not FILE | WAS | IS | WHY: src/solver/subject.f90 | do i = 1, n | why not'

# ---- what became of them ----

printf '%s\t%s\tsrc/%s\t%s\t%s\t%s\n' 0.1 'killed by decks' joint/a.f90:3 constant 'x = 1' 'x = 2' 0.2 survived joint/a.f90:4 constant 'y = 1' 'y = 2' \
   0.3 unbuilt run/b.f90:9 indices 'a(i, j)' 'a(j, i)' 0.4 'killed by: bad decks' run/b.f90:8 condition 'if (a)' 'if (.not. (a))' > results
"$here/mutants_table.awk" < results | same 'the tables' '| noticed by | mutants |
|---|---|
| bad decks | 1 |
| decks | 1 |

| folder | mutants | survived |
|---|---|---|
| joint | 2 | 1 |
| run | 1 | 0 |

| change | mutants | survived |
|---|---|---|
| condition | 1 | 0 |
| constant | 2 | 1 |

Survivors:
src/joint/a.f90:4: constant
   was  y = 1
   is   y = 2

3 mutants, 1 did not build and do not count, 1 survived: 33.3 %'

# ---- coverage ----

cat > counts <<'END'
        -:    0:Source:src/base/a.f90
        -:    1:module a
        3:    2:   call one()
    #####:    3:   call two()
       4*:    4:   three = 3
    =====:    5:   call four()
    #####:    6:end module a
        -:    0:Source:tests/unit/test_a.f90
    #####:    1:   call five()
        -:    0:Source:src/run/b.f90
    #####:    1:   six = 6
        -:    0:Source:src/run/b.f90
        1:    1:   six = 6
END
printf '# why\na.f90 | call two() | no memory\na.f90 | *our* | a guard\nb.f90 | nothing | gone\n' > explained
cover() { awk -v sources=src -v explained=explained -v least="$1" -f "$here/coverage_table.awk" counts; echo "status $?"; }
cover 60 | same 'coverage: the table' 'file                                       lines     ran        %
src/base/a.f90                                 4       2     50.0
src/run/b.f90                                  1       1    100.0

Lines that did not run:
src/base/a.f90:3: [no memory] call two()
src/base/a.f90:5: [a guard] call four()

    1  a guard
    1  no memory
explained: no such line is left: b.f90 | nothing

3 of 5 lines ran: 60.00 %
status 0'
cover 61 | tail -n 2 | same 'coverage: too little' 'less than 61 %
status 1'
sed -i '/our/d' explained
cover 60 | tail -n 2 | same 'coverage: a line that is not explained' '1 lines are not explained in explained
status 1'
: > counts
cover 60 | same 'coverage: nothing counted' 'no line was counted
status 1'

echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
