#!/bin/bash
# Tests the test runner: in a small project in a temporary folder, what must pass passes, and what must fail fails; what is compiled
# again after a change, and what make -q says. Runs the fallback, and pFUnit too where PFUNIT_DIR is set. Then what the project's own
# makefile makes of -j and of the numbers on its command line.
set -u
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
unset MAKEFLAGS MFLAGS MAKEOVERRIDES RUNNER
passed=0
failed=0
pf=tests/unit/test_case.pf

# ---- The small project -----------------------------------------------------------------------------

mkdir -p src tests/unit
cat > src/subject.f90 <<'END'
module subject
   implicit none
   private
   public :: quit
contains
   subroutine quit()
      stop
   end subroutine quit
end module subject
END
cat > src/caller.f90 <<'END'
module caller
   use subject, only: quit
   implicit none
   private
   public :: quit_for_good
contains
   subroutine quit_for_good()
      call quit()
   end subroutine quit_for_good
end module caller
END
cat > Makefile <<END
FC              := ${FC:-gfortran}
FFLAGS_CHECKED  := -O1 -g -std=f2018 -Wall -Wextra -fcheck=all -ffpe-trap=invalid,zero
BUILD           := build
CHECKED_MODULES := build/checked
CHECKED_LIBRARY := build/checked/libsubject.a
CHECKED_OBJECTS := build/checked/subject.o build/checked/caller.o
PF_FILES        := \$(sort \$(wildcard tests/unit/*.pf))
include $here/compile.mk
include $here/unit_tests.mk
\$(CHECKED_OBJECTS): build/checked/%.o: src/%.f90
	@mkdir -p \$(@D)
	\$(call compile,\$(FC) \$(FFLAGS_CHECKED) -J\$(@D) -c \$<)
build/checked/dependencies.mk: src/subject.f90 src/caller.f90
	@mkdir -p \$(@D) && awk -f $here/dependencies.awk -v folder=\$(@D) -v objects='\$(CHECKED_OBJECTS)' \$^ > \$@
-include build/checked/dependencies.mk
\$(CHECKED_LIBRARY): \$(CHECKED_OBJECTS)
	ar rcs \$@ \$^
END

# Write a test file from the routines on standard input; its first line becomes line 10.
suite() {
   cat > "${2:-$pf}" <<END
module ${1:-test_case}
   use funit
   use, intrinsic :: iso_fortran_env, only: wp => real64
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
   use subject, only: quit
   implicit none
   real(wp), parameter :: v(3) = [1.0_wp, 2.0_wp, 3.0_wp], m(2, 2) = reshape([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp], [2, 2])
   integer,  parameter :: iv(3) = [1, 2, 3], im(2, 2) = reshape([1, 2, 3, 4], [2, 2])
contains
$(cat)
   subroutine unused()
      call quit()
   end subroutine unused
   real(wp) function nan()
      nan = ieee_value(1.0_wp, ieee_quiet_nan)
   end function nan
   real(wp) function inf()
      inf = ieee_value(1.0_wp, ieee_positive_inf)
   end function inf
end module ${1:-test_case}
END
}

# A test routine for every assertion on standard input.
tests_of_lines() {
   local line i=0
   while read -r line; do
      i=$((i + 1))
      printf '   @test\n   subroutine case_%d()\n      %s\n   end subroutine case_%d\n' $i "$line" $i
   done
}

# ---- Checks ----------------------------------------------------------------------------------------

# Run the unit tests; then `output`, `status` and `closing` are set.
run() {
   output=$(make -j2 unit-test RUNNER=$runner "$@" 2>&1)
   status=$?
   closing=$(grep -E '^[0-9]+ passed, [0-9]+ failed$' <<< "$output" | tail -n 1)
}

# check NAME CONDITION...: count one check; show the output of the last run when it fails.
check() {
   local name=$1
   shift
   if "$@"; then
      passed=$((passed + 1))
   else
      failed=$((failed + 1))
      echo "FAILED: $name"
      sed 's/^/   | /' <<< "$output"
   fi
}

# The closing line and the success of the last run.
ended() { [ "$closing" = "$1" ] && if [ "$2" = success ]; then [ $status -eq 0 ]; else [ $status -ne 0 ]; fi; }
# make -q says that there is nothing to do, make -n names no command of the compiler
up_to_date() {
   make -q RUNNER=$runner build/unit-$runner/unit_tests && ! make -n RUNNER=$runner build/unit-$runner/unit_tests | grep -F -- ' -o '
}
shows() { grep -qF -- "$1" <<< "$output"; }
lacks() { ! shows "$1"; }

# Every assertion in a form that holds.
good_assertions() {
   cat <<'END'
@assertEqual(1.0_wp, v(1))
@assertEqual(1.0_wp, 1.1_wp, tolerance=0.2_wp, message='it''s close (enough, here)')
@assertEqual(expected=1.0_wp, actual=1.1_wp, tolerance=0.2_wp)
@assertEqual(1.0_wp, 1.1_wp, 0.2_wp)
@assertEqual([1.0_wp, 2.0_wp, 3.0_wp], v)
@assertEqual(m, m + 0.1_wp, tolerance=0.2_wp)
@assertEqual(m(:, 1:0), m(:, 1:0))
@assertEqual(inf(), inf())
@assertEqual([inf(), 1.0_wp], [inf(), 1.0_wp])
@assertEqual(3, size(v), message="count")
@assertEqual([1, 2, 3], iv)
@assertEqual(im, im)
@assertEqual('a, b)', 'a, '//'b)  ')
@assertEqual(.true., 1 < 2)
@assertEqual([.true., .false., .false.], v < 1.5_wp)
@assertNotEqual(1.0_wp, 1.1_wp)
@assertNotEqual(v, v + 1.0_wp, tolerance=0.5_wp)
@assertNotEqual(m, m + 1.0_wp)
@assertNotEqual(1, 2, message='integers')
@assertNotEqual(iv, iv + 1)
@assertNotEqual(im, im + 1)
@assertNotEqual(.true., .false.)
@assertLessThan(1.0_wp, 2.0_wp)
@assertLessThan(lhs=1.0_wp, rhs=1.0_wp, tolerance=0.1_wp)
@assertLessThan(v, v + 1.0_wp)
@assertLessThan(m, m + 1.0_wp)
@assertLessThan(1, 2)
@assertLessThan(iv, iv + 1)
@assertLessThan(im, im + 1)
@assertLessThanOrEqual(1.0_wp, 1.0_wp)
@assertLessThanOrEqual(v, v)
@assertLessThanOrEqual(m, m)
@assertLessThanOrEqual(1, 1)
@assertLessThanOrEqual(iv, iv)
@assertLessThanOrEqual(im, im)
@assertGreaterThan(2.0_wp, 1.0_wp)
@assertGreaterThan(v + 1.0_wp, v)
@assertGreaterThan(m + 1.0_wp, m)
@assertGreaterThan(2, 1)
@assertGreaterThan(iv + 1, iv)
@assertGreaterThan(im + 1, im)
@assertGreaterThanOrEqual(1.0_wp, 1.0_wp)
@assertGreaterThanOrEqual(v, v + 0.1_wp, tolerance=0.2_wp)
@assertGreaterThanOrEqual(m, m)
@assertGreaterThanOrEqual(1, 1)
@assertGreaterThanOrEqual(iv, iv)
@assertGreaterThanOrEqual(im, im)
@assertRelativelyEqual(100.0_wp, 101.0_wp, tolerance=0.011_wp)
@assertRelativelyEqual(-v, -1.01_wp*v, tolerance=0.011_wp)
@assertRelativelyEqual(m, 1.01_wp*m, 0.011_wp, message='m')
@assertTrue(1 == 1)
@asserttrue (v > 0.0_wp)
@assertTrue(all(v > 0.0_wp), 'message by position')
@assertFalse(1 == 2, message='scalar')
@assertFalse(v < 0.0_wp)
@assertIsNaN(nan())
@assertIsFinite(1.0_wp, message='one')
END
}

# Every assertion in a form that does not hold.
bad_assertions() {
   cat <<'END'
@assertEqual(1.0_wp, 1.1_wp)
@assertEqual(0.0_wp, 1.0e-30_wp)
@assertEqual(1.0_wp, 1.1_wp, tolerance=0.05_wp, message='words of the test')
@assertEqual(v, v + [0.0_wp, 0.0_wp, 1.0_wp])
@assertEqual(m, transpose(m))
@assertEqual(v, v(:2))
@assertEqual(v(1:0), v)
@assertEqual(m, m(:, 1:1))
@assertEqual(inf(), 1.0_wp, tolerance=1.0_wp)
@assertEqual(-inf(), inf())
@assertEqual(2, size(v))
@assertEqual([1, 2, 4], iv)
@assertEqual(im, transpose(im))
@assertEqual([1, 2], iv)
@assertEqual('abc', 'abd')
@assertEqual('abc', 'abcd')
@assertEqual(.true., 2 < 1)
@assertEqual([.true., .true.], [.true., .false.])
@assertNotEqual(1.0_wp, 1.0_wp)
@assertNotEqual(1.0_wp, 1.1_wp, tolerance=0.2_wp)
@assertNotEqual(v, [0.0_wp, 0.0_wp, 3.0_wp])
@assertNotEqual(inf(), inf())
@assertNotEqual(1, 1)
@assertNotEqual(iv, [1, 5, 6])
@assertNotEqual(.true., .true.)
@assertLessThan(1.0_wp, 1.0_wp)
@assertLessThan(v, v + [1.0_wp, 1.0_wp, 0.0_wp])
@assertLessThan(m, m)
@assertLessThan(1, 1)
@assertLessThan(v, v(:2))
@assertLessThanOrEqual(1.1_wp, 1.0_wp)
@assertLessThanOrEqual(iv, iv - 1)
@assertGreaterThan(1.0_wp, 1.0_wp)
@assertGreaterThan(im, im)
@assertGreaterThanOrEqual(1.0_wp, 1.1_wp)
@assertGreaterThanOrEqual(iv, iv + 1)
@assertRelativelyEqual(100.0_wp, 101.0_wp, tolerance=0.009_wp)
@assertRelativelyEqual(0.0_wp, 0.0_wp, tolerance=0.1_wp)
@assertRelativelyEqual(m, 1.1_wp*m, tolerance=0.01_wp)
@assertTrue(1 == 2)
@assertTrue(v > 1.5_wp)
@assertFalse(1 == 1)
@assertFalse(v > 1.5_wp)
@assertIsNaN(1.0_wp)
@assertIsFinite(inf())
@assertIsFinite(nan())
@assertEqual(nan(), nan())
@assertEqual(1.0_wp, nan(), tolerance=1.0_wp)
@assertEqual([1.0_wp, nan()], [1.0_wp, 1.0_wp], tolerance=1.0_wp)
@assertEqual(1.0_wp, 1.1_wp, tolerance=nan())
@assertNotEqual(1.0_wp, nan())
@assertLessThan(nan(), 1.0_wp)
@assertLessThan(1.0_wp, nan())
@assertLessThanOrEqual(nan(), nan())
@assertGreaterThan(nan(), 1.0_wp)
@assertGreaterThanOrEqual([nan(), nan()], [1.0_wp, nan()])
@assertRelativelyEqual(1.0_wp, nan(), tolerance=1.0_wp)
@assertRelativelyEqual(nan(), 1.0_wp, tolerance=1.0_wp)
END
}

# What pFUnit's compiler refuses, or what it lets pass and funit does not.
bad_assertions_of_fallback() {
   cat <<'END'
@assertEqual(1, 1.0_wp)
@assertEqual(1.0_wp, v)
@assertEqual(v(1), v(1:1))
@assertEqual(m, v)
@assertEqual(1, 1, tolerance=1.0_wp)
@assertEqual('1', 1)
@assertNotEqual('a', 'b')
@assertLessThan(.false., .true.)
@assertNotEqual([nan(), 1.0_wp], [1.0_wp, 2.0_wp])
@assertRelativelyEqual(inf(), 1.0_wp, tolerance=1.0_wp)
END
}

# ---- Runs ------------------------------------------------------------------------------------------

check_all_fail() {
   local count i
   $1 | tests_of_lines | suite
   count=$($1 | wc -l)
   run
   check "$runner: $1 all fail" ended "0 passed, $count failed" failure
   for ((i = 1; i <= count; i++)); do
      check "$runner: $1, $($1 | sed -n ${i}p)" shows "test_case.pf:$((8 + 4*i))"
   done
}

check_runner() {
   local count
   rm -f tests/unit/*.pf
   run
   check "$runner: without test files" ended '0 passed, 0 failed' failure

   good_assertions | tests_of_lines | suite
   count=$(good_assertions | wc -l)
   run
   check "$runner: good assertions" ended "$count passed, 0 failed" success
   check "$runner: the closing line is the last" [ "$(tail -n 1 <<< "$output")" = "$closing" ]

   check_all_fail bad_assertions
   check "$runner: the message is shown" shows 'words of the test'
   [ $runner = fallback ] && check_all_fail bad_assertions_of_fallback

   suite <<'END'
   @before
   subroutine set_up()
      level = level + 1
   end subroutine set_up
   @after
   subroutine tear_down()
      level = level - 1
   end subroutine tear_down
   @test
   ! A comment may stand here.
   subroutine first
      @assertEqual(1, level)
   end subroutine first
   @test
   subroutine second()
      @assertEqual(1, level)
   end subroutine second
   @test
   @disable
   subroutine third()
      call quit()
   end subroutine third
END
   sed -i 's/^   implicit none$/&\n   integer :: level = 0/' $pf
   run
   check "$runner: before, after and disable" ended '2 passed, 0 failed' success

   suite <<'END'
   @before
   subroutine set_up()
      @assertTrue(.false.)
   end subroutine set_up
   @after
   subroutine tear_down()
      call quit()
   end subroutine tear_down
   @test
   subroutine first()
      call quit()
   end subroutine first
END
   run
   check "$runner: nothing runs after a failed before" ended '0 passed, 1 failed' failure

   suite <<'END'
   @test
   subroutine returns()
      @assertTrue(.false.)
      call quit()
   end subroutine returns
   @test
   subroutine calls_helper()
      call helper()
      @assertTrue(.true., message='returns here too, the test has failed')
      call quit()
   end subroutine calls_helper
   subroutine helper()
      @assertTrue(.false.)
      call quit()
   end subroutine helper
   @test
   subroutine holds()
      @assertTrue(.true.)
   end subroutine holds
END
   run
   check "$runner: a failed assertion returns" ended '1 passed, 2 failed' failure
   check "$runner: the program itself tells failure" [ "$(build/unit-$runner/unit_tests > log 2>&1; echo $?)" != 0 ]

   tests_of_lines <<< 'call quit()' | suite
   run
   check "$runner: a stop in the code under test" ended '' failure
   check "$runner: a stop is reported" shows 'ended without a summary'
   tests_of_lines <<< 'error stop' | suite
   run
   check "$runner: an error stop" ended '' failure

   printf '   @test\n   @disable\n   subroutine only()\n   end subroutine only\n' | suite
   run
   check "$runner: all tests disabled" ended '0 passed, 0 failed' failure

   tests_of_lines <<< '@assertTrue(.true.)' | suite
   tests_of_lines <<< '@assertTrue(.true.)' | suite test_other tests/unit/test_other.pf
   run
   check "$runner: a second file" ended '2 passed, 0 failed' success
   run UNIT_NAMES=test_case
   check "$runner: a file is lost" ended '1 passed, 0 failed' failure
   run
   run
   check "$runner: nothing to build" lacks "${FC:-gfortran}"
   touch tests/unit/test_other.pf
   run
   check "$runner: a changed file is built" shows test_other
   check "$runner: nothing else is built" lacks "-o build/unit-$runner/test_case.o"
   check "$runner: after that nothing is to be built" up_to_date
   touch src/subject.f90
   check "$runner: a change is to be built" eval '! up_to_date > /dev/null'
   run
   check "$runner: what uses a module whose interface is as before is not built" lacks "-o build/unit-$runner/test_case.o"
   check "$runner: after a touched source nothing is to be built" up_to_date
   sed -i "s/^ *stop.*/      if (index('$runner', 'f') > 0) stop/" src/subject.f90
   run
   check "$runner: another body of a routine: its module is built" shows '-o build/checked/subject.o'
   check "$runner: another body of a routine: no module that uses it" lacks '-o build/checked/caller.o'
   check "$runner: another body of a routine: no test that uses it" lacks "-o build/unit-$runner/test_case.o"
   check "$runner: another body of a routine: the program is linked" shows "-o build/unit-$runner/unit_tests"
   check "$runner: after another body nothing is to be built" up_to_date
   sed -i "0,/^contains/s//   integer, parameter, public :: later_$runner = 1\ncontains/" src/subject.f90
   run
   check "$runner: what uses a changed module is built" shows "-o build/unit-$runner/test_case.o"
   check "$runner: a module that uses a changed module is built" shows '-o build/checked/caller.o'
   check "$runner: after another interface nothing is to be built" up_to_date
   sed -i 's/subroutine unused/subroutine also_unused/; s/call quit/call unused/; s/use subject.*/use test_case, only: unused/' \
      tests/unit/test_other.pf
   run
   sed -i "0,/^contains/s//   integer, parameter, public :: later_$runner = 1\ncontains/" $pf
   run
   check "$runner: what uses a changed test file is built" shows "-o build/unit-$runner/test_other.o"
   check "$runner: and runs" ended '2 passed, 0 failed' success
   rm tests/unit/test_other.pf
   run
   check "$runner: a file is gone" ended '1 passed, 0 failed' success

   tests_of_lines <<< '@assertNothing(.true.)' | suite
   run
   check "$runner: refused" ended '' failure
   check "$runner: refused with its place" shows "$pf:12: "
}

# refused LINE WHY: the translator refuses the test file for its line LINE, under every awk that is there.
refused() {
   local awk
   for awk in awk mawk gawk; do
      command -v $awk > /dev/null || continue
      output=$($awk -f "$here/pf_to_fortran.awk" $pf 2>&1 > /dev/null)
      status=$?
      check "$awk refuses: $2" eval "[ $status -ne 0 ] && shows '$pf:$1: '"
   done
}

check_refusals() {
   local line
   while read -r line; do
      tests_of_lines <<< "$line" | suite
      refused 12 "$line"
   done <<'END'
@assertAlmost(1, 2)
@assertEqual(1)
@assertEqual
@assertEqual(1, 2) ! a comment
@assertEqual(1, 2) ; x = 1
@assertEqual(1, &
@assertEqual(1, , 2)
@assertEqual(1, 2, 'message by position')
@assertEqual(1, 2, whitespace=1)
@assertEqual(lhs=1, rhs=2)
@assertLessThan(expected=1, actual=2)
@assertRelativelyEqual(1.0_wp, 1.0_wp)
@assertRelativelyEqual(1.0_wp, 1.0_wp, message='no tolerance')
@assertTrue(.true., tolerance=1.0_wp)
@assertTrue()
if (.true.) @assertTrue(.true.)
call assertTrue(.true.)
@mpiAssertTrue(.true.)
@test(ifdef=X)
@testCase
@suite(name='x')
@disable
#define X
! for tests/unit/*.pf the preprocessor opens a comment
END
   for line in t suite run initialize finalize; do
      tests_of_lines <<< '' | sed "s/case_1/$line/" | suite
      refused 11 "a test named $line"
   done
   tests_of_lines <<< '' | suite; sed -i 's/^   implicit none$/&\n   integer, private :: suite\n   integer :: v2, t = 1/' $pf
   refused 8 'a public variable named t'
   tests_of_lines <<< '' | sed 's/()/(this)/' | suite
   refused 11 'a test with an argument'
   tests_of_lines <<< '' | sed 's/@test/& ! why/' | suite
   refused 10 'a comment after @test'
   printf '   @test\n   integer function f()\n   end function f\n' | suite
   refused 11 'a function as a test'
   tests_of_lines <<< '@before' | suite
   refused 13 'before an end statement'
   suite < /dev/null
   refused "$(wc -l < $pf)" 'no test'
   tests_of_lines <<< '' | suite test_name
   refused 1 'module and file differ'
   tests_of_lines <<< '' | suite; sed -i '1s/$/ ! why/' $pf
   refused 1 'a comment after the module statement'
   tests_of_lines <<< '' | suite; sed -i 's/use funit/use funit, only: assertTrue/' $pf
   refused "$(wc -l < $pf)" 'a restricted use of funit'
}

# ---- The makefile of the project ---------------------------------------------------------------------

# asked given|'' ARGUMENT...: whether the project's makefile sees that the arguments give a number of jobs; else it takes all cores
asked() {
   local jobs=$1 is
   shift
   output=$(env ${SETTING:+"$SETTING"} make -C "$here/../.." BUILD="$work/project" "$@" -pn help 2>&1)
   is=$(sed -n 's/^JOBS_ASKED := *//p' <<< "$output")
   output="JOBS_ASKED is '$is'"
   check "make $* ${SETTING:-}" [ "${is:+given}" = "$jobs" ]
}

# ends_with PATTERN ARGUMENTS: what make ARGUMENTS would do ends with a command that fits the PATTERN
ends_with() {
   output=$(make -C "$here/../.." BUILD="$work/project" -n $2 2>&1 | grep -A 1 -E '(pairs|fuzz|mutants)[.]sh')
   check "make $2" grep -qE -- "$1" <<< "$output"
}

check_project() {
   local wish
   asked ''
   asked '' -k
   for wish in -j1 -j3 --jobs=2 -kj2; do asked given $wish; done
   for wish in -j1 j2 kj2; do SETTING=MAKEFLAGS=$wish asked given; done

   # numbers: each target has its own defaults, the command line rules
   ends_with "pairs.sh -s '[0-9]{9,}' -f '1' -n '1000' " pairs
   ends_with "pairs.sh -s '3' -f '7' -n '20' " 'pairs SEED=3 FROM=7 N=20'
   ends_with "fuzz.sh -s '[0-9]{9,}' -f '1' -m '5' " fuzz
   ends_with "fuzz.sh -s '9' -f '1' -m '2' " 'fuzz SEED=9 MINUTES=2'
   ends_with "fuzz.sh -s '9' -f '1' -n '100' " 'fuzz SEED=9 DECKS=100'
   ends_with "mutants.sh .* '150' '1'\$" mutants-run
   ends_with "mutants.sh .* '3' '2026'\$" 'mutants-run N=3 SEED=2026'
   for wish in 'pairs N=abc' 'pairs SEED=x' 'pairs N=' 'fuzz MINUTES=abc' 'fuzz MINUTES=1.5' 'fuzz DECKS=-1' 'mutants JOBS=two'; do
      output=$(make -C "$here/../.." BUILD="$work/project" -n $wish 2>&1)
      status=$?
      check "make $wish: refused" [ $status -eq 2 ]
      check "make $wish: told why" shows "${wish#* }: expected a whole number"
      check "make $wish: nothing begins" lacks ' -o '
   done
}

check_project
for runner in fallback ${PFUNIT_DIR:+pfunit}; do
   check_runner
done
check_refusals
echo "$passed passed, $failed failed"
[ $failed -eq 0 ] && [ $passed -gt 0 ]
