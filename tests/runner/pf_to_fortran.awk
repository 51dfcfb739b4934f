# Translates a pFUnit 4 test file into Fortran for the module funit in this folder, line by line, so that the compiler's line
# numbers are those of the .pf file. The routine <module>_suite, which runs the tests, follows the module.
#
#    awk -f pf_to_fortran.awk tests/unit/test_x.pf > test_x.f90
#    awk -v mode=driver -f pf_to_fortran.awk test_x test_y > driver.f90      the main program, from the module names alone
#
# The dialect is what both pFUnit and funit accept. Everything else is refused with `file:line: reason` on standard error and exit
# status 1, also what pFUnit would silently take for something else. Runs in any POSIX awk.

BEGIN {
   if (mode == "driver") { write_driver(); finished = 1; exit }
   # Directive, in lower case, to its spelling, and to the names of its operands in order.
   split("assertEqual assertNotEqual assertRelativelyEqual", names, " ")
   for (i in names) declare(names[i], "expected actual")
   split("assertLessThan assertLessThanOrEqual assertGreaterThan assertGreaterThanOrEqual", names, " ")
   for (i in names) declare(names[i], "lhs rhs")
   declare("assertTrue", "condition"); declare("assertFalse", "condition")
   declare("assertIsNaN", "x"); declare("assertIsFinite", "x")
   # Names that pFUnit's generated code or its module already uses.
   split("t suite run initialize finalize generic_run get_context stub test disable is every true false", names, " ")
   for (i in names) taken[names[i]] = 1
}

function declare(name, operands) {
   spelling[tolower(name)] = name
   operand_names[tolower(name)] = operands
}

# ---- One line ------------------------------------------------------------------------------------

FNR == 1 {
   base = FILENAME
   sub(/.*\//, "", base); sub(/\.pf$/, "", base)
   base = tolower(base)
}

index($0, "/*") { refuse("'/*' opens a comment for the preprocessor that pFUnit runs") }

/^[ \t]*(!|$)/ { print; next }

/^[ \t]*#/ { refuse("a preprocessor line"); next }

after_module { refuse("nothing but comments may follow the module") }

/^[ \t]*@/ { directive(); next }

{
   statement = tolower(without_text($0))
   if (index(statement, "@")) refuse("a directive stands first on its line")
   if (statement ~ /(^|[^a-z0-9_])call +assert/) refuse("write an assertion as a directive, '@assert...'")
   if (pending != "") take_routine()
   check_module()
   check_name()
   if (!contained) check_data()
   print
}

# Directives. `pending` is the one that waits for its subroutine.
function directive(    text, name) {
   text = $0
   gsub(/^[ \t]+|[ \t]+$/, "", text)
   match(text, /^@[A-Za-z0-9_]*/)
   name = tolower(substr(text, 2, RLENGTH - 1))
   text = substr(text, RLENGTH + 1)
   if (name in spelling) {
      if (pending != "") refuse("a subroutine must follow '@" pending "'")
      assertion(name, text)
   } else if (name == "test" || name == "before" || name == "after" || name == "disable") {
      if (text != "") refuse("'@" name "' stands alone on its line")
      if (name == "disable") {
         if (pending != "test") refuse("'@disable' follows '@test'")
         disabled = 1
      } else {
         if (pending != "") refuse("a subroutine must follow '@" pending "'")
         if (name in fixture) refuse("a second '@" name "'")
         pending = name
      }
      print "!" $0
   } else {
      refuse("unknown directive '@" name "'")
   }
}

# The statement after @test, @before or @after.
function take_routine(    name) {
   name = statement
   if (name !~ /^ *subroutine +[a-z][a-z0-9_]* *(\( *\))? *$/) {
      refuse("'subroutine name()' must follow '@" pending "'")
   } else {
      sub(/^ *subroutine +/, "", name); sub(/[ (].*/, "", name)
      if (pending == "test") {
         test_name[++test_count] = name
         test_disabled[test_count] = disabled
      } else {
         fixture[pending] = name
      }
   }
   pending = ""
   disabled = 0
}

function check_module(    name) {
   if (statement ~ /^ *end *module/) after_module = 1
   if (statement ~ /^ *use +funit *$/) uses_funit = 1
   if (statement !~ /^ *module +[a-z]/ || statement ~ /^ *module +(procedure|subroutine|function)[ :]/) return
   name = statement
   gsub(/^ *module +| +$/, "", name)
   if (module != "") refuse("a second module")
   if (tolower($0) !~ /^[ \t]*module[ \t]+[a-z0-9_]+[ \t]*$/) refuse("the module statement stands alone on its line")
   else if (name != base) refuse("the module is named '" name "', its file '" base "'")
   module = name
}

function check_name(    name) {
   if (statement ~ /^ *end/ || !match(statement, /(^| )(subroutine|function) +[a-z0-9_]+/)) return
   name = substr(statement, RSTART, RLENGTH)
   sub(/.* /, "", name)
   if (name in taken) refuse("the name '" name "' belongs to pFUnit")
}

# What the module declares above `contains`, public unless it says otherwise.
function check_data(    name, declared) {
   if (statement ~ /^ *contains *$/) contained = 1
   if (statement ~ /^ *private *$/) is_private = 1
   if (is_private || statement ~ /^ *use |private/ || !index(statement, "::")) return
   declared = substr(statement, index(statement, "::") + 2)
   for (name in taken) if (declared ~ ("(^|[ ,])" name " *([=,(]|$)")) refuse("the name '" name "' belongs to pFUnit: make it private")
}

# ---- Assertions ----------------------------------------------------------------------------------

# Write the call of one assertion; `text` is what follows its name.
function assertion(name, text,    operands, operand_count, argument, count, i, keyword, value, list, has_tolerance) {
   operand_count = split(operand_names[name], operands, " ")
   count = split_arguments(text, argument)
   if (count < 0) return
   if (count < operand_count) refuse("'@" spelling[name] "' has too few arguments")
   for (i = 1; i <= count; i++) {
      value = argument[i]
      keyword = ""
      if (match(value, /^[A-Za-z][A-Za-z0-9_]*[ \t]*=/) && substr(value, RLENGTH + 1, 1) != "=") {
         keyword = tolower(substr(value, 1, RLENGTH - 1))
         sub(/[ \t]+$/, "", keyword)
         value = substr(value, RLENGTH + 1)
      } else if (i <= operand_count) {
         keyword = operands[i]
      } else if (i == operand_count + 1 && value !~ /^["']/) {
         keyword = operand_count == 2 ? "tolerance" : "message"
      } else {
         keyword = "message"
         if (operand_count == 2) refuse("give the message as 'message=...'")
      }
      if (keyword == operands[1]) list = list ", " wrapped(name, "a", value)
      else if (operand_count == 2 && keyword == operands[2]) list = list ", " wrapped(name, "b", value)
      else if (keyword == "message" || (keyword == "tolerance" && operand_count == 2)) list = list ", " keyword "=" value
      else refuse("'@" spelling[name] "' has no argument '" keyword "'")
      if (keyword == "tolerance") has_tolerance = 1
   }
   if (name == "assertrelativelyequal" && !has_tolerance) refuse("'@assertRelativelyEqual' needs a tolerance")
   if (operand_count == 2) list = "assert_relation('" spelling[name] "'" list
   else list = spelling[name] "(" substr(list, 3)
   match($0, /^[ \t]*/)
   print substr($0, 1, RLENGTH) "call " list ", location='" FILENAME ":" FNR "'); if (anyExceptions()) return"
}

# One operand, in the form in which funit takes it.
function wrapped(name, dummy, value) {
   if (name == "asserttrue") return "condition=all([" value "])"
   if (name == "assertfalse") return "condition=any([" value "])"
   if (name == "assertisnan" || name == "assertisfinite") return "x=" value
   return dummy "=operand_of(" value ")"
}

# Split "(a, b(1, 2), 'x, y')" at its outer commas. Returns the count, or -1 with the reason told.
function split_arguments(text, argument,    mask, i, c, depth, start, count) {
   sub(/^[ \t]+/, "", text)
   mask = without_text(text)
   if (substr(mask, 1, 1) != "(") { refuse("'(' expected after the assertion"); return -1 }
   start = 2
   for (i = 1; i <= length(mask); i++) {
      c = substr(mask, i, 1)
      if (c == "(" || c == "[") depth++
      if (c == ")" || c == "]") depth--
      if ((c == "," && depth == 1) || depth == 0) {
         argument[++count] = substr(text, start, i - start)
         gsub(/^[ \t]+|[ \t]+$/, "", argument[count])
         if (argument[count] == "") { refuse("an empty argument"); return -1 }
         start = i + 1
      }
      if (depth == 0) break
   }
   if (depth != 0) { refuse("an assertion is complete on one line"); return -1 }
   if (start <= length(text)) { refuse("nothing may follow an assertion on its line"); return -1 }
   return count
}

# The line with the inside of its strings as '_', its tabs as blanks, and its comment cut off.
function without_text(line,    i, c, quote, result) {
   for (i = 1; i <= length(line); i++) {
      c = substr(line, i, 1)
      if (quote != "") {
         if (c == quote) quote = ""
         else c = "_"
      } else if (c == "!") {
         break
      } else if (c == "'" || c == "\"") {
         quote = c
      } else if (c == "\t") {
         c = " "
      }
      result = result c
   }
   sub(/ +$/, "", result)
   return result
}

# ---- Ends ----------------------------------------------------------------------------------------

function refuse(reason) {
   print FILENAME ":" FNR ": " reason > "/dev/stderr"
   refused = 1
}

END {
   if (finished) exit
   if (pending != "") refuse("'@" pending "' at the end of the file")
   if (module == "") refuse("no module")
   else if (!uses_funit) refuse("no line 'use funit'")
   if (!test_count) refuse("no '@test'")
   if (refused) exit 1
   write_suite()
}

function write_suite(    i, options, list) {
   options = ("before" in fixture) ? ", before=" fixture["before"] : ""
   if ("after" in fixture) options = options ", after=" fixture["after"]
   for (i = 1; i <= test_count; i++) list = list (i > 1 ? ", " : "") test_name[i]
   for (i in fixture) list = list ", " fixture[i]
   print "\nsubroutine " module "_suite()"
   print "   use funit, only: run_test, skip_test"
   print "   use " module ", only: " list
   print "   implicit none\n"
   for (i = 1; i <= test_count; i++) {
      if (test_disabled[i]) print "   call skip_test('" module "', '" test_name[i] "')"
      else print "   call run_test('" module "', '" test_name[i] "', " test_name[i] options ")"
   }
   print "end subroutine " module "_suite"
}

function write_driver(    i, name) {
   for (i = 1; i < ARGC; i++) {
      name = ARGV[i]
      sub(/.*\//, "", name); sub(/\.pf$/, "", name)
      suites = suites "   call " name "_suite()\n"
      externals = externals "   external :: " name "_suite\n"
   }
   printf "program unit_tests\n   use funit, only: finish_tests\n   implicit none\n%s\n%s", externals, suites
   printf "   call finish_tests()\nend program unit_tests\n"
}
