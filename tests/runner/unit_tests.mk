# The unit tests, tests/unit/*.pf, built and run under one of two runners:
#
#    make unit-test                    pfunit where PFUNIT_DIR is set, else fallback
#    make unit-test RUNNER=fallback    the translator and the module funit beside this file
#    make unit-test RUNNER=pfunit      the pFUnit that is installed under PFUNIT_DIR
#    make unit-test ONLY=test_gaps     one file of them, or several names
#
# The including makefile sets, above the include, FC, FFLAGS_CHECKED, BUILD, PF_FILES, CHECKED_LIBRARY, its CHECKED_OBJECTS, their
# folder CHECKED_MODULES and LIBRARIES, includes compile.mk, names its own default target and has a rule for CHECKED_LIBRARY. The run fails when a
# test fails, when none ran, when fewer ran than are written, and when the program ends before its summary. The last line is
# `N passed, N failed`.

AWK ?= awk
RUNNER ?= $(if $(PFUNIT_DIR),pfunit,fallback)

UNIT_RUNNER  := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
UNIT_FOLDER  := $(BUILD)/unit-$(RUNNER)
UNIT_CHOSEN  := $(if $(ONLY),$(ONLY:%=tests/unit/%.pf),$(PF_FILES))
UNIT_PROGRAM := $(UNIT_FOLDER)/unit_tests$(if $(ONLY),_only)
UNIT_DRIVER  := $(UNIT_FOLDER)/driver$(if $(ONLY),_only)
UNIT_NAMES   := $(notdir $(basename $(UNIT_CHOSEN)))
UNIT_OBJECTS := $(UNIT_NAMES:%=$(UNIT_FOLDER)/%.o)
UNIT_SHARED  := $(sort $(wildcard tests/unit/*.f90))
UNIT_HELPERS := $(UNIT_SHARED:tests/unit/%.f90=$(UNIT_FOLDER)/%.o)
# Of results of a derived type with allocatable components the compiler says that bounds behind a null pointer are uninitialized
UNIT_COMPILE  = $(FC) $(FFLAGS_CHECKED) $(UNIT_OPTIMISE) -Wno-uninitialized -Wno-maybe-uninitialized -ffree-line-length-none -J$(UNIT_FOLDER)
# The tests themselves are compiled without optimisation, for their compilation takes longer than their run; not so the independent
# computations that they use
UNIT_OPTIMISE = -O0
$(UNIT_HELPERS): private UNIT_OPTIMISE =
UNIT_CHECK    = $(AWK) -f $(UNIT_RUNNER)/pf_to_fortran.awk

.PHONY: unit-test unit-force
unit-force:

# Show the log of a run without its lines of passed tests, and judge it.
# written: tests in the .pf files; status: exit status of the program.
define UNIT_REPORT
/: ok$$/ { next }
/^[0-9]+ passed, [0-9]+ failed$$/ { passed = $$1; failed = $$3; summary = 1; next }
/^ *\([0-9]+ tests?[,)]/ { passed = substr($$1, 2) + 0; failed = 0; summary = 1 }
/^Tests run: [0-9]+, Failures: / { failed = $$5 + $$7; passed = $$3 - failed; summary = 1 }
{ print }
END {
   if (!summary) reason = "the run ended without a summary, with status " status
   else if (passed + failed != written) reason = written " tests are written, " passed + failed " ran"
   else if (!written) reason = "no test ran"
   else if (!failed && status != 0) reason = "all passed, but the program ended with status " status
   if (reason != "") print "unit tests: " reason
   if (summary) print passed " passed, " failed " failed"
   exit reason != "" || failed > 0
}
endef
export UNIT_REPORT

# BLAS has one thread here, as the program gives it: several wait for each other by asking again and again, which takes many times
# the work itself where other parts have the cores. An OpenBLAS that does not know the processor takes a slow kernel, which the program
# replaces; here every processor with AVX2 has the kernel Haswell.
unit-test: $(UNIT_PROGRAM)
	@written=$$(cat /dev/null $(UNIT_CHOSEN) | \
	   $(AWK) 'tolower($$1) == "@test" { n++ } tolower($$1) == "@disable" { n-- } END { print n + 0 }'); \
	scratch=$$(mktemp -d $(UNIT_FOLDER)/scratch.XXXXXX); trap 'rm -rf $$scratch' EXIT; \
	if grep -qsw avx2 /proc/cpuinfo; then export OPENBLAS_CORETYPE=$${OPENBLAS_CORETYPE:-Haswell}; fi; \
	status=0; OPENBLAS_NUM_THREADS=1 UNIT_SCRATCH=$$scratch $(UNIT_PROGRAM) > $(UNIT_PROGRAM).log 2>&1 || status=$$?; \
	$(AWK) -v written=$$written -v status=$$status "$$UNIT_REPORT" $(UNIT_PROGRAM).log

$(UNIT_FOLDER):
	@mkdir -p $@

# The names of the tests: written anew, so that the program is linked again, only when a test file comes or goes
ifneq ($(file < $(UNIT_DRIVER).names),$(UNIT_NAMES))
.PHONY: $(UNIT_DRIVER).names
endif
$(UNIT_DRIVER).names: | $(UNIT_FOLDER)
	@printf '%s\n' '$(UNIT_NAMES)' > $@

# Modules that several test files use.
$(UNIT_HELPERS): $(UNIT_FOLDER)/%.o: tests/unit/%.f90 | $(UNIT_FOLDER) $(CHECKED_LIBRARY)
	$(call compile,$(UNIT_COMPILE) -I$(CHECKED_MODULES) -c $<)

# An object waits for the library, and is made anew for the modules alone that it uses.
$(UNIT_FOLDER)/dependencies.mk: $(PF_FILES) $(UNIT_SHARED) $(UNIT_RUNNER)/dependencies.awk | $(UNIT_FOLDER)
	@$(AWK) -v folder=$(UNIT_FOLDER) -v objects='$(PF_FILES:tests/unit/%.pf=$(UNIT_FOLDER)/%.o) $(UNIT_HELPERS) $(CHECKED_OBJECTS)' \
	   -f $(UNIT_RUNNER)/dependencies.awk /dev/null $(PF_FILES) $(UNIT_SHARED) > $@

ifneq ($(MAKECMDGOALS),clean)
-include $(UNIT_FOLDER)/dependencies.mk
endif

ifeq ($(RUNNER),fallback)

# A refused file leaves no Fortran behind.
$(UNIT_NAMES:%=$(UNIT_FOLDER)/%.f90): $(UNIT_FOLDER)/%.f90: tests/unit/%.pf $(UNIT_RUNNER)/pf_to_fortran.awk | $(UNIT_FOLDER)
	@$(UNIT_CHECK) $< > $@.part && mv $@.part $@

$(UNIT_OBJECTS): $(UNIT_FOLDER)/%.o: $(UNIT_FOLDER)/%.f90 $(UNIT_FOLDER)/funit.o | $(CHECKED_LIBRARY)
	$(call compile,$(UNIT_COMPILE) -I$(CHECKED_MODULES) -c $<)

$(UNIT_FOLDER)/funit.o: $(UNIT_RUNNER)/funit.f90 | $(UNIT_FOLDER)
	$(call compile,$(UNIT_COMPILE) -c $<)

$(UNIT_DRIVER).f90: $(UNIT_DRIVER).names
	@$(UNIT_CHECK) -v mode=driver $(UNIT_NAMES) > $@.part && mv $@.part $@

$(UNIT_DRIVER).o: $(UNIT_DRIVER).f90 $(UNIT_FOLDER)/funit.o
	$(call compile,$(UNIT_COMPILE) -c $<)

$(UNIT_PROGRAM): $(UNIT_DRIVER).o $(UNIT_OBJECTS) $(UNIT_HELPERS) $(UNIT_FOLDER)/funit.o $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -o $@ $^ $(LIBRARIES)

else ifeq ($(RUNNER),pfunit)

UNIT_PFUNIT := $(firstword $(wildcard $(PFUNIT_DIR)/PFUNIT-*/include/PFUNIT.mk $(PFUNIT_DIR)/include/PFUNIT.mk))
ifeq ($(UNIT_PFUNIT),)

$(UNIT_PROGRAM): unit-force
	@echo "unit tests: no PFUNIT.mk below PFUNIT_DIR='$(PFUNIT_DIR)'" >&2; exit 1

else

include $(UNIT_PFUNIT)

# The translator of the fallback goes first: pFUnit passes over in silence what it refuses.
$(UNIT_NAMES:%=$(UNIT_FOLDER)/%.F90): $(UNIT_FOLDER)/%.F90: \
      tests/unit/%.pf $(UNIT_RUNNER)/pf_to_fortran.awk $(UNIT_PFUNIT) | $(UNIT_FOLDER)
	@$(UNIT_CHECK) $< > /dev/null
	@python3 $(PFUNIT_BIN_DIR)/funitproc -quiet $< $@.part > /dev/null && mv $@.part $@

$(UNIT_OBJECTS): $(UNIT_FOLDER)/%.o: $(UNIT_FOLDER)/%.F90 | $(CHECKED_LIBRARY)
	$(call compile,$(UNIT_COMPILE) -I$(CHECKED_MODULES) $(PFUNIT_EXTRA_FFLAGS) -c $<)

$(UNIT_DRIVER)_suites.inc: $(UNIT_DRIVER).names
	@for name in $(UNIT_NAMES); do echo "ADD_TEST_SUITE($${name}_suite)"; done > $@

# No trapped exceptions here: pFUnit raises them itself when it compares infinities or a NaN.
$(UNIT_DRIVER).o: $(PFUNIT_INCLUDE_DIR)/driver.F90 $(UNIT_DRIVER)_suites.inc
	$(filter-out -ffpe-trap=%,$(UNIT_COMPILE)) $(PFUNIT_EXTRA_FFLAGS) -I$(UNIT_FOLDER) -D_TEST_SUITES='"$(notdir $(UNIT_DRIVER))_suites.inc"' -c $< -o $@

$(UNIT_PROGRAM): $(UNIT_DRIVER).o $(UNIT_OBJECTS) $(UNIT_HELPERS) $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -o $@ $^ $(LIBRARIES) $(PFUNIT_LIBRARIES)

endif

else
$(error RUNNER=$(RUNNER): it is 'fallback' or 'pfunit')
endif
