# Writes the dependences of objects as lines of a makefile, from the `use` lines of Fortran sources; a file is named after its
# module.
#
#    awk -f dependencies.awk -v folder=build/release -v objects='build/release/kinds.o ...' src/*/*.f90
#
# FOLDER receives the objects of these sources; OBJECTS lists all objects that they may need; a module without an object is skipped.
# An object depends on the objects of the modules that it uses; compile.mk compiles it only where an interface among them has changed, so
# that a change inside a routine rebuilds one object. A submodule, `submodule(parent) name`, depends on the object of its parent.

BEGIN {
   n = split(objects, path, " ")
   for (i = 1; i <= n; i++) object[name_of(path[i])] = path[i]
}

FNR == 1 { me = name_of(FILENAME) }

$1 == "use" {
   used = $2
   sub(/,.*/, "", used)
   if (used in object) print folder "/" me ".o: " object[used]
}

/^submodule\(/ {
   used = $0
   gsub(/^submodule\(|\).*/, "", used)
   if (used in object) print folder "/" me ".o: " object[used]
}

function name_of(path) {
   gsub(/.*\/|\.[a-z0-9]*$/, "", path)
   return path
}
