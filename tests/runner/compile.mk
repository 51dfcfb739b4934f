# The command that compiles one Fortran source to the target $@, for the makefiles that include this file.
#
#    target.o: source.f90 used.o ...
#            $(call compile,gfortran -O2 -Jfolder -c $<)
#
# An object has the objects of the modules that it uses as prerequisites (dependencies.awk). Where none of their .mod files and none of
# the other prerequisites is newer than $@, only the body of a used routine has changed: the target gets a new time and is not compiled.
# So `make -q` tells the truth, which it does not with the usual rule `%.mod: %.o`. The compiler writes a .mod file, or the .smod file
# of a module with submodules, only when its contents change.
define compile
@changed=$$(find $(filter-out %.o %.a,$^) $(patsubst %.o,%.mod,$(filter %.o,$^)) -newer $@ 2>&1 || echo missing); \
if [ -e $@ ] && [ -z "$$changed" ]; then touch $@; else echo '$(subst ','\'',$(1) -o $@)'; $(1) -o $@; fi
endef
