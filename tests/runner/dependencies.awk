# Writes the dependences of objects as lines of a makefile, from the `use` lines of Fortran sources; a file is named after its
# module.
#
#    awk -f dependencies.awk -v folder=build/release -v objects='build/release/kinds.o ...' src/*/*.f90
#
# FOLDER receives the objects of these sources; OBJECTS lists all objects that they may need; a module without an object is skipped.
# An object depends on the .mod files of the modules that it uses. The compiler rewrites a .mod file only when an interface changes,
# so a change inside a routine rebuilds one object. The including makefile has the rule `%.mod: %.o`. A submodule,
# `submodule(parent) name`, depends on the object of its parent.

BEGIN {
   n = split(objects, path, " ")
   for (i = 1; i <= n; i++) object[name_of(path[i])] = path[i]
}

FNR == 1 { me = name_of(FILENAME) }

$1 == "use" {
   used = $2
   sub(/,.*/, "", used)
   if (used in object) print folder "/" me ".o: " module_file(object[used])
}

/^submodule\(/ {
   used = $0
   gsub(/^submodule\(|\).*/, "", used)
   if (used in object) print folder "/" me ".o: " object[used]
}

function module_file(path) {
   sub(/\.o$/, ".mod", path)
   return path
}

function name_of(path) {
   gsub(/.*\/|\.[a-z0-9]*$/, "", path)
   return path
}
