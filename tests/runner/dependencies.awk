# Which object needs which, as lines of a makefile, from the `use` lines of Fortran sources; a file is named as its module.
#
#    awk -f dependencies.awk -v folder=build/release -v objects='build/release/kinds.o ...' src/*/*.f90
#
# An object waits for the .mod files of the modules that it uses, which the compiler rewrites only when an interface changes: a change
# inside a routine rebuilds one object. The including makefile has the rule `%.mod: %.o`. A submodule, `submodule(parent) name`, waits
# for the object of its parent.
#
# FOLDER: where the objects of these sources go; OBJECTS: all that they may need. A module without an object is passed over.

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
