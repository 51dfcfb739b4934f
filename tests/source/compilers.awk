# Fortran that some compilers refuse or get wrong, though it is right. Prints FILE:LINE: the pattern: the statement.
#
#    awk -f compilers.awk FILE... FILE...      every file twice: names of functions are collected first
#
#    bound      associate (a => b(f(i))): a function of the same module in a subscript of a selector. gfortran 13 and 14 do not know it yet
#               ('should be a FUNCTION', 'Rank mismatch').
#    nested     associate (a => b(n + 1)) inside associate (n => table(k)%n): the name of an associate around it whose selector is an
#               expression, a function or a component of a table, in a subscript of a selector. gfortran 13 and 14: 'has no IMPLICIT type',
#               'Rank mismatch'.
#    argument   call s(x(:, f(i + 1))), also of min, max, size: a section as an argument, with a function of an expression as subscript.
#               gfortran 14 with -fcheck=bounds evaluates the subscript before the argument of the function is set.
#    blocked    a pure internal procedure that changes a variable of its host. flang refuses it.

# The statement without text and comment; strings are underlines
function bare(line,   i, c, quote, out) {
   for (i = 1; i <= length(line); i++) {
      c = substr(line, i, 1)
      if (quote != "") { if (c == quote) quote = ""; c = "_" }
      else if (c == "'" || c == "\"") { quote = c; c = "_" }
      else if (c == "!") break
      out = out c
   }
   sub(/[ \t]+$/, "", out)
   return out
}

# The place behind the bracket that closes the one before place I of TEXT
function closing(text, i,   depth, c) {
   for (depth = 1; i <= length(text) && depth > 0; i++) {
      c = substr(text, i, 1)
      if (c ~ /[(\[]/) depth++
      if (c ~ /[)\]]/) depth--
   }
   return i
}

# The parts of TEXT between its outer commas: item[1] to item[n]
function split_outer(text, item,   n, i, c, depth) {
   split("", item)
   n = 1
   for (i = 1; i <= length(text); i++) {
      c = substr(text, i, 1)
      if (c ~ /[(\[]/) depth++
      if (c ~ /[)\]]/) depth--
      if (c == "," && depth == 0) n++
      else item[n] = item[n] c
   }
   return n
}

function tell(pattern) { print FILENAME ":" first ": " pattern ": " statement; found++ }

# Whether TEXT calls a function for which an expression is the argument
function calls_of_expression(text,   i, name, inner, list, n, k, rest) {
   rest = text
   while (match(rest, /[a-z_0-9]+\(/)) {
      name = substr(rest, RSTART, RLENGTH - 1)
      inner = substr(rest, RSTART + RLENGTH)
      if (name in is_scalar || name ~ /^(min|max|size)$/) {
         n = split_outer(substr(inner, 1, closing(inner, 1) - 2), list)
         for (k = 1; k <= n; k++) if (list[k] !~ /^ *[a-z_0-9%]+ *$/ || (name == "min" || name == "max")) return 1
      }
      rest = inner
   }
   return 0
}

# The name before the bracket that is open at the end of TEXT; empty where none is open, or it is no call
function caller(text,   i, c, depth, before) {
   for (i = length(text); i > 0; i--) {
      c = substr(text, i, 1)
      if (c ~ /[)\]]/) depth++
      if (c ~ /[(\[]/ && depth-- == 0) {
         before = substr(text, 1, i - 1)
         return c == "(" && match(before, /[a-z_0-9@%]+$/) ? substr(before, RSTART) : ""
      }
   }
   return ""
}

function check_associate(body,   item, n, i, k, name, outside, selector, inside, word, rest) {
   n = split_outer(body, item)
   depth++
   for (i = 1; i <= n; i++) {
      name = item[i]; sub(/ *=>.*/, "", name); gsub(/ /, "", name)
      selector = item[i]; sub(/^[^>]*> */, "", selector)
      inside = index(selector, "(") ? substr(selector, index(selector, "(") + 1) : ""
      rest = inside
      while (match(rest, /[a-z_0-9]+\(/)) {
         word = substr(rest, RSTART, RLENGTH - 1)
         outside = substr(selector, 1, length(selector) - length(rest) + RSTART - 1)
         rest = substr(rest, RSTART + RLENGTH)
         if (!((FILENAME, word) in of_file)) continue
         outside = caller(outside)
         sub(/.*%/, "", outside)
         if (!(outside in is_function) && outside !~ intrinsic) tell("bound")
      }
      for (k in unresolved) if (unresolved[k] < depth && (" " inside " ") ~ ("[^a-z_0-9%]" k "[^a-z_0-9%]")) tell("nested")
      word = selector; sub(/\(.*/, "", word); gsub(/ /, "", word)
      if (selector ~ /[-+*\/]/ && selector !~ /\(.*[-+*\/].*\)/ || selector ~ /table\(.*\)%/ || word in is_function && selector !~ /%[a-z_0-9]+$/) {
         if (selector !~ /^ *[a-z_0-9]+\(.*\) *$/ || (FILENAME, word) in of_file) unresolved[name] = depth
      }
   }
}

function check_arguments(   rest, at, name, inside, item, n, i, is_section) {
   at = 0
   while (match(substr(statement, at + 1), /[a-z_0-9]+\(/)) {
      rest = substr(statement, 1, at + RSTART - 1)
      at += RSTART + RLENGTH - 1
      inside = substr(statement, at + 1)
      inside = substr(inside, 1, closing(inside, 1) - 2)
      n = split_outer(inside, item)
      is_section = 0
      for (i = 1; i <= n; i++) if (item[i] ~ /^[^(]*:/) is_section = 1
      if (n < 2 || !is_section) continue
      for (i = 1; i <= n; i++) if (item[i] !~ /^[^(]*:/ && item[i] !~ /^ *\[/ && calls_of_expression(item[i])) {
         sub(/%?[a-z_0-9%]*$/, "", rest)
         name = caller(rest)
         if (name != "" && name !~ intrinsic) tell("argument")
         break
      }
   }
}

BEGIN { intrinsic = "^(if|sum|all|any|count|minval|maxval|norm2|matmul|dot_product|abs|pack|spread|reshape|min|max|size|merge|modulo)$" }
FNR == 1 { part = "" ; depth = 0; split("", unresolved); pure = ""; second = FILENAME in seen; seen[FILENAME] = 1 }
{
   line = tolower(bare($0))
   if (line == "") next
   if (part == "") first = FNR
   if (line ~ /&$/) { sub(/&$/, " ", line); part = part line; next }
   statement = part line; part = ""
   gsub(/ +/, " ", statement); sub(/^ /, "", statement)
   if (!second) {
      if (statement ~ /(^| )function [a-z_0-9]+ ?\(/ && statement !~ /^end/) {
         name = statement; sub(/.*function /, "", name); sub(/ ?\(.*/, "", name)
         is_function[name] = 1; of_file[FILENAME, name] = 1
         if (statement ~ /^(pure |elemental |recursive )*integer(\([a-z]+\))? function /) is_scalar[name] = 1
      }
      next
   }
   if (statement ~ /^([a-z_0-9]+: )?associate ?\(/) {
      body = statement; sub(/^[^(]*\(/, "", body); sub(/\) *$/, "", body)
      check_associate(body)
   } else if (statement ~ /^end ?associate/) {
      for (k in unresolved) if (unresolved[k] == depth) delete unresolved[k]
      depth--
   } else check_arguments()
   if (statement ~ /^(pure |elemental )/ && statement ~ /(subroutine|function) [a-z_0-9]+/ && internal) pure = "inside"
   if (statement == "contains") { internal = in_routine }
   if (statement ~ /^end (subroutine|function)/) {
      if (pure != "") pure = ""
      else { in_routine = 0; internal = 0 }
      split("", own)
   } else if (statement ~ /(^| )(subroutine|function) [a-z_0-9]+ ?(\(|$)/ && !internal) in_routine = 1
   if (pure != "" && statement ~ /::/) {
      names = statement; sub(/.*:: ?/, "", names)
      n = split_outer(names, item)
      for (i = 1; i <= n; i++) { name = item[i]; sub(/[ (=].*/, "", name); gsub(/ /, "", name); sub(/^ */, "", item[i]); sub(/[ (=].*/, "", item[i]); own[item[i]] = 1 }
   } else if (pure != "" && statement ~ /(^|[^<>=\/])=[^=>]/ && statement ~ /^[a-z_0-9%]+(\([^=]*\))?(%[a-z_0-9]+(\([^=]*\))?)* = /) {
      name = statement; sub(/[ (%=].*/, "", name)
      if (!(name in own)) tell("blocked")
   } else if (statement ~ /(subroutine|function) [a-z_0-9]+ ?\(/ && pure != "") {
      name = statement; sub(/.*(subroutine|function) /, "", name); sub(/[ (].*/, "", name); own[name] = 1
      if (statement ~ /result ?\(/) { name = statement; sub(/.*result ?\(/, "", name); sub(/\).*/, "", name); own[name] = 1 }
   }
}
END { exit found > 0 }
