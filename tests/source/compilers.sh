#!/usr/bin/env bash
# No statement that gfortran 13 or 14 or flang refuses or gets wrong: compilers.awk lists them, gfortran 12 accepts them all. First,
# that it finds each of them in small modules.
#
#    compilers.sh FOLDER...
set -u
passed=0 failed=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# finds PATTERN TIMES: in the module whose procedures stand on the standard input
finds() {
   local found
   { echo 'module small'; echo 'contains'; cat; echo 'end module small'; } > "$scratch/small.f90"
   found=$(awk -f tests/source/compilers.awk "$scratch/small.f90" "$scratch/small.f90" | grep -c ": $1: ")
   if [ "$found" = "$2" ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED $1: $found found, $2 expected"; fi
}

finds bound 2 <<'END'
   subroutine s(a, i)
      associate (p => a%parts(a%part_of(i)), x => a%x(:, nodes_on(a, i)), y => sum(part_of(a, i)))
         call t(p, x)
      end associate
   end subroutine s
   pure integer function part_of(a, i)
   end function part_of
   pure function nodes_on(a, i) result(n)
   end function nodes_on
END
finds nested 3 <<'END'
   subroutine s(a, i)
      associate (n => element_table(i)%n, k => i + 1, c => nodes_of(a), whole => a%x)
         associate (x => a%x(:, n), y => a%x(k, 1), z => a%x(:, c), w => whole(:, i))
         end associate
      end associate
      associate (x => a%x(:, n))
      end associate
   end subroutine s
   pure function nodes_of(a) result(n)
   end function nodes_of
END
finds argument 3 <<'END'
   subroutine s(x, i)
      call t(x(:, f(i + 1)))
      y = g(x(:2, c(min(i, 3))))//'x(:, f(i + 1))'
      y = h(g(x(:, &
              f(10*i))))
      z = x(:, f(i + 1)) ! call t(x(:, f(i + 1)))
      call t(x(:, f(i)), x(:, c(i + 1)), x(1, f(i + 1)))
      z = sum(x(:, f(i + 1)))
   end subroutine s
   pure integer function f(i)
   end function f
END
finds blocked 1 <<'END'
   pure real function total(x)
      real, intent(in) :: x(:)
      total = 0.0
      call add(x(1))
   contains
      pure subroutine add(y)
         real, intent(in) :: y
         real :: z
         z = y
         total = total + z
      end subroutine add
   end function total
END

for folder; do find "$folder" -name '*.f90' -o -name '*.pf'; done | sort > "$scratch/files"
mapfile -t files < "$scratch/files"
if [ ${#files[@]} -gt 0 ] && awk -f tests/source/compilers.awk "${files[@]}" "${files[@]}"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
