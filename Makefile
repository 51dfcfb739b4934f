# jointfem: build, run, test. `make help` lists the targets.

FC        ?= gfortran
ifeq ($(origin FC),default)
FC         = gfortran
endif
BUILD      = build
WARNINGS   = -std=f2018 -Wall -Wextra
FFLAGS     = -O2 -fopenmp -fno-backtrace $(WARNINGS)
# the check of recursion would take another thread in the same routine for one
FFLAGS_CHECKED = -O1 -g -fopenmp $(WARNINGS) -fcheck=all,no-array-temps,no-recursion -ffpe-trap=invalid,zero
LIBRARIES  = -lmetis -lopenblas

SOURCES    = $(sort $(wildcard src/*/*.f90))
MODULES    = $(notdir $(SOURCES:.f90=))
VPATH      = $(sort $(dir $(SOURCES)))

RELEASE_OBJECTS = $(MODULES:%=$(BUILD)/release/%.o)
CHECKED_OBJECTS = $(MODULES:%=$(BUILD)/checked/%.o)
CHECKED_LIBRARY = $(BUILD)/checked/libjointfem.a
CHECKED_MODULES = $(BUILD)/checked
PF_FILES        = $(sort $(wildcard tests/unit/*.pf))

.PHONY: all
all: bin/jointfem bin/jointfit

.PHONY: help
help:
	@echo 'make            the program, bin/jointfem'
	@echo 'make run        the worked example: the prism with 3, 5, 10 and 15 increments'
	@echo 'make test       unit tests, every deck of input against reference_output, bad decks'
	@echo 'make check      only the decks against reference_output'
	@echo 'make accept CASE=name    take the results of input/name.bdf as the new reference'
	@echo 'make bench      speed and memory, MODELS=small: only of small models'
	@echo 'make figures    the pictures, from the CSV files of the decks; DATA=file: of test data and their fit'
	@echo 'make clean'

# The program, optimised and with run-time checks -----------------------------------------------------------------

bin/jointfem: src/jointfem.f90 $(RELEASE_OBJECTS)
	@mkdir -p bin
	$(FC) $(FFLAGS) -I$(BUILD)/release -o $@ $< $(RELEASE_OBJECTS) $(LIBRARIES)

bin/jointfit: src/jointfit.f90 $(RELEASE_OBJECTS)
	@mkdir -p bin
	$(FC) $(FFLAGS) -I$(BUILD)/release -o $@ $< $(RELEASE_OBJECTS) $(LIBRARIES)

$(BUILD)/checked/jointfit: src/jointfit.f90 $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -I$(CHECKED_MODULES) -o $@ $< $(CHECKED_LIBRARY) $(LIBRARIES)

$(BUILD)/checked/jointfem: src/jointfem.f90 $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -I$(CHECKED_MODULES) -o $@ $< $(CHECKED_LIBRARY) $(LIBRARIES)

$(CHECKED_LIBRARY): $(CHECKED_OBJECTS)
	@rm -f $@
	ar rcs $@ $(CHECKED_OBJECTS)

$(BUILD)/release/%.o: %.f90
	@mkdir -p $(@D)
	$(FC) $(FFLAGS) -J$(@D) -c -o $@ $<

$(BUILD)/checked/%.o: %.f90
	@mkdir -p $(@D)
	$(FC) $(FFLAGS_CHECKED) -J$(@D) -c -o $@ $<

$(BUILD)/dependencies.mk: $(SOURCES) tests/runner/dependencies.awk Makefile
	@mkdir -p $(@D)
	@for way in release checked; do awk -v folder=$(BUILD)/$$way -v objects="$$(printf "$(BUILD)/$$way/%s.o " $(MODULES))" \
	   -f tests/runner/dependencies.awk $(SOURCES); done > $@

ifneq ($(MAKECMDGOALS),clean)
-include $(BUILD)/dependencies.mk
endif

# The worked example ----------------------------------------------------------------------------------------------

.PHONY: run
run: bin/jointfem bin/jointfit
	@mkdir -p $(BUILD)/run
	bin/jointfem -o $(BUILD)/run input/prism03.bdf input/prism05.bdf input/prism10.bdf input/prism15.bdf
	@awk -f tests/prism_table.awk $(BUILD)/run/prism03.joint.csv $(BUILD)/run/prism05.joint.csv \
	   $(BUILD)/run/prism10.joint.csv $(BUILD)/run/prism15.joint.csv
	@echo 'listings and joint histories: $(BUILD)/run'

# Tests -----------------------------------------------------------------------------------------------------------

include tests/runner/unit_tests.mk

COMPARE = $(BUILD)/compare/compare_results

$(COMPARE): tests/compare/comparison_text.f90 tests/compare/comparison_rules.f90 tests/compare/compare_results.f90
	@mkdir -p $(@D)
	$(FC) $(FFLAGS) -J$(@D) -o $@ $^

.PHONY: test
test: bin/jointfem $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit $(COMPARE) $(UNIT_PROGRAM)
	@MAKE='$(MAKE)' tests/run_all.sh bin/jointfem $(BUILD)/checked/jointfem $(COMPARE) $(BUILD)

.PHONY: check
check: bin/jointfem $(COMPARE)
	@tests/check.sh bin/jointfem $(COMPARE) $(BUILD)/check

# The results of one deck become its reference: make accept CASE=prism05
.PHONY: accept
accept: bin/jointfem
	@test -n '$(CASE)' || { echo 'usage: make accept CASE=name, for input/name.bdf'; exit 1; }
	@test -f 'input/$(CASE).bdf' || { echo 'there is no deck input/$(CASE).bdf'; exit 1; }
	@mkdir -p $(BUILD)/accept
	bin/jointfem -q -o $(BUILD)/accept 'input/$(CASE).bdf'
	cp '$(BUILD)/accept/$(CASE).out' '$(BUILD)/accept/$(CASE).joint.csv' reference_output
	@echo 'say in the commit message why the reference changed'

# Speed and pictures ----------------------------------------------------------------------------------------------

include tests/bench/bench.mk

.PHONY: figures
figures: bin/jointfem bin/jointfit
ifdef DATA
	@mkdir -p $(BUILD)/figures
	bin/jointfit $(OPTIONS) --plot $(BUILD)/figures/fit.gp '$(DATA)' > $(BUILD)/figures/fit.bdf
	gnuplot $(BUILD)/figures/fit.gp
else
	@reference_output/figures/draw.sh bin/jointfem bin/jointfit $(BUILD)/figures
endif

.PHONY: clean
clean:
	rm -rf $(BUILD) bin
