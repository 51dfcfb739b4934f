# jointfem: build, run, test. `make help` lists the targets.

FC        ?= gfortran
ifeq ($(origin FC),default)
FC         = gfortran
endif
# make's own rules are left out: one takes a .mod file for a source of Modula-2
MAKEFLAGS += -r
# A `make` without -j builds on all cores. GNU make 4.3 does not show -j in MAKEFLAGS while it reads this file, so that the command line
# is asked, and the MAKEFLAGS of a make that has started this one.
JOBS_ASKED := $(shell { tr '\0' '\n' < /proc/$$PPID/cmdline; printf '%s\n' $$MAKEFLAGS; } | \
                grep -E -e '^(-[A-Za-z]*j|--jobs)' -e '^[a-zA-Z]*j[0-9]*$$' -m 1)
ifeq ($(JOBS_ASKED)$(filter -j%,$(MAKEFLAGS)),)
MAKEFLAGS += -j$(shell nproc)
endif

BUILD      = build
BIN        = bin
WARNINGS   = -std=f2018 -Wall -Wextra
# FFLAGS of the user, from the command line or the environment, follow the flags of the project
# -fcheck=mem reports a failed allocation that the compiler makes on its own
FFLAGS_RELEASE = -O2 -fopenmp -fcheck=mem -fno-backtrace $(WARNINGS) $(FFLAGS)
# -march=native: this processor multiplies and adds in one instruction, which may change no answer.
# -fcheck=recursion would take a second thread in a routine for a recursion
FFLAGS_CHECKED = -O1 -g -march=native -fopenmp $(WARNINGS) -fcheck=all,no-array-temps,no-recursion -ffpe-trap=invalid,zero $(FFLAGS)
LIBRARIES  = -larpack -lmetis -lminpack -lopenblas

MANUAL     = $(BUILD)/manual/card_manual.f90
SOURCES    = $(sort $(filter-out src/mpi/%,$(wildcard src/*/*.f90))) $(MANUAL)
# on the processes of mpirun with PETSc: `make mpi`
MPI_FC      = mpifort
MPI_SOURCES = $(sort $(wildcard src/mpi/*.f90))
MPI_OBJECTS = $(MPI_SOURCES:src/%.f90=$(BUILD)/%.o)
MODULES    = $(notdir $(SOURCES:.f90=))
VPATH      = $(sort $(dir $(SOURCES)))

RELEASE_OBJECTS = $(MODULES:%=$(BUILD)/release/%.o)
# the objects that the unit tests are linked with; `make unit-test CHECKED=release`: those of the program
CHECKED         = checked
CHECKED_MODULES = $(BUILD)/$(CHECKED)
CHECKED_OBJECTS = $(MODULES:%=$(CHECKED_MODULES)/%.o)
CHECKED_LIBRARY = $(CHECKED_MODULES)/libjointfem.a
COMPARISONS     = $(sort $(wildcard tests/compare/*.f90))
DEPENDENCIES    = awk -f tests/runner/dependencies.awk
PF_FILES        = $(sort $(wildcard tests/unit/*.pf))

.PHONY: all
all: bin/jointfem bin/jointfit

.PHONY: help
help:
	@echo 'make            the program, bin/jointfem'
	@echo 'make mpi        the program on several processes, bin/jointfem_mpi; needs PETSc'
	@echo 'make run        the worked example: the prism with 3, 5, 10 and 15 increments'
	@echo 'make test       unit tests, every deck of input against reference_output, bad decks'
	@echo 'make unit-test  only the unit tests; ONLY=test_joint_gaps: of that file; CHECKED=release: of the program'
	@echo 'make check      only the decks against reference_output'
	@echo 'make sanitize   decks under the address, undefined and thread sanitizers, and valgrind: minutes'
	@echo 'make platforms  both commands of README.md on Debian 13, in a root folder made by debootstrap; as root'
	@echo 'make install PREFIX=dir  programs, manual pages, documents; default /usr/local'
	@echo 'make accept CASE=name    take the results of input/name.bdf as the new reference; TABLES="stage bolt": of these too'
	@echo 'make accept ACCEPT=failed   those of all decks that failed the last make check'
	@echo 'make manual     the verification manual, reference_output/README.md, from runs'
	@echo 'make modules    the list of the modules, src/modules.md, from their first lines'
	@echo 'make bench      speed and memory, MODELS=small: only of small models'
	@echo 'make coverage   which lines of src no test runs'
	@echo 'make mutants    which single changes of src no test notices: N=150 SEED=1 JOBS=1'
	@echo 'make figures    the pictures, from the CSV files of the decks'
	@echo 'make figures DECK=path   pressure, deflection and loops of the joints of any deck'
	@echo 'make report DECK=path    a page of the results of any deck, with pictures'
	@echo 'make figures DATA=file   test data and their fit'
	@echo 'make fuzz MINUTES=60 SEED=7  decks made at random, through the program, with run-time checks and sanitizers'
	@echo 'make pairs N=5000 SEED=7  decks in which every pair of features meets: other solver, renumbered, mirrored, turned, other units'
	@echo 'make structures  known laws of 50 random structures, by jointfit --structure: FIRST=1 LAST=50'
	@echo 'make clean'

include tests/runner/compile.mk

# The program, optimised and with run-time checks -----------------------------------------------------------------

$(BIN)/jointfem: src/jointfem.f90 $(RELEASE_OBJECTS)
	@mkdir -p $(@D)
	$(FC) $(FFLAGS_RELEASE) -I$(BUILD)/release -o $@ $< $(RELEASE_OBJECTS) $(LIBRARIES)

# The program on several processes
.PHONY: mpi
mpi:
	@pkg-config --exists petsc || { echo 'make mpi needs PETSc and pkg-config: apt-get install libpetsc-real-dev pkg-config'; exit 1; }
	@$(MAKE) --no-print-directory PETSC="$$(pkg-config --libs petsc)" PETSC_MODULES="$$(pkg-config --cflags-only-I petsc)" \
	   $(BIN)/jointfem_mpi

# It has the objects of the program for one process, but for the submodule that is the one process
$(BIN)/jointfem_mpi: src/jointfem.f90 $(RELEASE_OBJECTS) $(MPI_OBJECTS)
	@mkdir -p $(@D)
	$(MPI_FC) $(FFLAGS_RELEASE) -I$(BUILD)/release -o $@ $< $(filter-out %/serial_backend.o,$(RELEASE_OBJECTS)) $(MPI_OBJECTS) \
	   $(PETSC) $(LIBRARIES)

$(BIN)/jointfit: src/jointfit.f90 $(RELEASE_OBJECTS)
	@mkdir -p $(@D)
	$(FC) $(FFLAGS_RELEASE) -I$(BUILD)/release -o $@ $< $(RELEASE_OBJECTS) $(LIBRARIES)

$(BUILD)/checked/jointfit: src/jointfit.f90 $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -I$(CHECKED_MODULES) -o $@ $< $(CHECKED_LIBRARY) $(LIBRARIES)

$(BUILD)/checked/jointfem: src/jointfem.f90 $(CHECKED_LIBRARY)
	$(FC) $(FFLAGS_CHECKED) -I$(CHECKED_MODULES) -o $@ $< $(CHECKED_LIBRARY) $(LIBRARIES)

$(CHECKED_LIBRARY): $(CHECKED_OBJECTS)
	@rm -f $@
	ar rcs $@ $(CHECKED_OBJECTS)

# Compiler and flags of the objects: the file is rewritten, and the objects are rebuilt, when either changes
RELEASE_STAMP = $(BUILD)/release.flags
CHECKED_STAMP = $(BUILD)/checked.flags
$(RELEASE_STAMP): private text = $(FC) $(FFLAGS_RELEASE)
$(CHECKED_STAMP): private text = $(FC) $(FFLAGS_CHECKED)
ifneq ($(file < $(RELEASE_STAMP)),$(FC) $(FFLAGS_RELEASE))
.PHONY: $(RELEASE_STAMP)
endif
ifneq ($(file < $(CHECKED_STAMP)),$(FC) $(FFLAGS_CHECKED))
.PHONY: $(CHECKED_STAMP)
endif
$(RELEASE_STAMP) $(CHECKED_STAMP):
	@mkdir -p $(@D)
	@printf '%s\n' '$(text)' > $@

$(BUILD)/release/%.o: %.f90 $(RELEASE_STAMP)
	@mkdir -p $(@D)
	$(call compile,$(FC) $(FFLAGS_RELEASE) -J$(@D) -c $<)

$(BUILD)/mpi/%.o: src/mpi/%.f90 $(RELEASE_STAMP)
	@mkdir -p $(@D)
	$(call compile,$(MPI_FC) $(FFLAGS_RELEASE) -I$(BUILD)/release $(PETSC_MODULES) -J$(@D) -c $<)

$(BUILD)/checked/%.o: %.f90 $(CHECKED_STAMP)
	@mkdir -p $(@D)
	$(call compile,$(FC) $(FFLAGS_CHECKED) -J$(@D) -c $<)

# The entries of the card manual, for --help
$(MANUAL): input/cards.md src/run/card_manual.awk
	@mkdir -p $(@D)
	@awk -f src/run/card_manual.awk $< > $@.part && mv $@.part $@

# Which object needs which, from the `use` lines
$(BUILD)/dependencies.mk: $(SOURCES) $(MPI_SOURCES) $(COMPARISONS) tests/runner/dependencies.awk Makefile
	@mkdir -p $(@D)
	@$(DEPENDENCIES) -v folder=$(BUILD)/release -v objects='$(RELEASE_OBJECTS)' $(SOURCES) > $@
	@$(DEPENDENCIES) -v folder=$(BUILD)/checked -v objects='$(CHECKED_OBJECTS)' $(SOURCES) >> $@
	@$(DEPENDENCIES) -v folder=$(BUILD)/mpi -v objects='$(RELEASE_OBJECTS) $(MPI_OBJECTS)' $(MPI_SOURCES) >> $@
	@$(DEPENDENCIES) -v folder=$(BUILD)/compare -v objects='$(COMPARISONS:tests/%.f90=$(BUILD)/%.o)' $(COMPARISONS) >> $@

ifneq ($(MAKECMDGOALS),clean)
-include $(BUILD)/dependencies.mk
endif

# Installation ----------------------------------------------------------------------------------------------------

PREFIX      = /usr/local
MAN_PAGES   = $(BUILD)/man/jointfem.1 $(BUILD)/man/jointfit.1
PLACE       = $(DESTDIR)$(PREFIX)

$(BUILD)/man/jointfem.1: private about = structures with flexible joints by the step-wise tangent-stiffness method
$(BUILD)/man/jointfit.1: private about = laws of joints from test data
$(MAN_PAGES): $(BUILD)/man/%.1: bin/% src/run/man_page.awk
	@mkdir -p $(@D)
	@bin/$* --help | awk -v name=$* -v version="$$(bin/$* --version)" -v about='$(about)' -f src/run/man_page.awk > $@

.PHONY: install
install: bin/jointfem bin/jointfit $(MAN_PAGES)
	install -d '$(PLACE)/bin' '$(PLACE)/share/man/man1' '$(PLACE)/share/doc/jointfem'
	install -m 755 bin/jointfem bin/jointfit '$(PLACE)/bin'
	install -m 644 $(MAN_PAGES) '$(PLACE)/share/man/man1'
	install -m 644 README.md '$(PLACE)/share/doc/jointfem'
	cp -R input reference_output '$(PLACE)/share/doc/jointfem'

# The worked example ----------------------------------------------------------------------------------------------

.PHONY: run
run: bin/jointfem bin/jointfit
	@mkdir -p $(BUILD)/run
	bin/jointfem -o $(BUILD)/run input/prism03.bdf input/prism05.bdf input/prism10.bdf input/prism15.bdf
	@awk -f tests/exact/prism_table.awk $(BUILD)/run/prism03.joint.csv $(BUILD)/run/prism05.joint.csv \
	   $(BUILD)/run/prism10.joint.csv $(BUILD)/run/prism15.joint.csv
	@echo 'listings and joint histories: $(BUILD)/run'

# Tests -----------------------------------------------------------------------------------------------------------

include tests/runner/unit_tests.mk
$(UNIT_OBJECTS) $(UNIT_HELPERS): $(CHECKED_STAMP)

COMPARE = $(BUILD)/compare/compare_results
QUERY   = $(BUILD)/compare/query_results

$(COMPARE): $(addprefix $(BUILD)/compare/,comparison_text.o comparison_rules.o compare_results.o)
	$(FC) $(FFLAGS_RELEASE) -o $@ $^

$(QUERY): $(addprefix $(BUILD)/compare/,comparison_text.o csv_table.o query_expression.o query_results.o)
	$(FC) $(FFLAGS_RELEASE) -o $@ $^

$(BUILD)/compare/%.o: tests/compare/%.f90 $(RELEASE_STAMP)
	@mkdir -p $(@D)
	$(call compile,$(FC) $(FFLAGS_RELEASE) -J$(@D) -c $<)

.PHONY: test
test: bin/jointfem bin/jointfit $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit $(COMPARE) $(QUERY) $(UNIT_PROGRAM)
	@if pkg-config --exists petsc 2> /dev/null && command -v mpirun > /dev/null; then $(MAKE) --no-print-directory mpi; fi
	@MAKE='$(MAKE)' tests/run_all.sh bin/jointfem $(BUILD)/checked/jointfem $(COMPARE) $(QUERY) $(BUILD) bin/jointfem_mpi

# Known laws of random structures from values with noise
.PHONY: structures
structures: bin/jointfem bin/jointfit
	@tests/fit/structure.sh bin/jointfit bin/jointfem $(or $(FIRST),1) $(or $(LAST),50)

.PHONY: check
check: bin/jointfem $(COMPARE)
	@tests/compare/check.sh bin/jointfem $(COMPARE) $(BUILD)/check

# The two commands of README.md on other systems, as root
.PHONY: platforms
platforms:
	@tests/platforms/debian13.sh whole $(BUILD)/platforms

# PART=threads: only that part
.PHONY: sanitize
sanitize: bin/jointfem
	@MAKE='$(MAKE)' FC='$(FC)' LIBRARIES='$(LIBRARIES)' tests/source/sanitize.sh $(BUILD)/sanitize $(PART)

# CASE=prism05: the results of this deck become its reference; ACCEPT=failed: those of all that failed the last `make check`
.PHONY: accept
accept: bin/jointfem $(COMPARE)
	@TABLES='$(TABLES)' tests/compare/accept.sh bin/jointfem $(COMPARE) $(BUILD)/accept $(if $(filter failed,$(ACCEPT)),--failed $(BUILD)/check,'$(CASE)')

# The verification manual, its numbers from runs
.PHONY: manual
manual: bin/jointfem $(QUERY)
	@tests/manual/make.sh bin/jointfem $(QUERY) $(BUILD)/manual-runs reference_output/README.md

# The list of the modules, from their first lines
.PHONY: modules
modules:
	@tests/source/modules.sh src/README.md src > $(BUILD)/modules.part && mv $(BUILD)/modules.part src/modules.md

# Speed and pictures ----------------------------------------------------------------------------------------------

include tests/random/fuzz.mk
include tests/bench/bench.mk
include tests/source/coverage.mk
include tests/source/mutants.mk

# The figures of the paper; with DECK=path those of one deck, with DATA=file those of test data
.PHONY: figures
ifdef DECK
figures: bin/jointfem
	@reference_output/figures/deck.sh bin/jointfem '$(DECK)' $(BUILD)/figures
else ifdef DATA
figures: bin/jointfit
	@mkdir -p $(BUILD)/figures
	bin/jointfit $(OPTIONS) --plot $(BUILD)/figures/fit.gp '$(DATA)' > $(BUILD)/figures/fit.bdf
	gnuplot $(BUILD)/figures/fit.gp
else
figures: bin/jointfem bin/jointfit $(QUERY)
	@reference_output/figures/draw.sh bin/jointfem bin/jointfit $(QUERY) $(BUILD)/figures
endif

# One page of the results of a deck
.PHONY: report
report: bin/jointfem
	@python3 reference_output/figures/report.py bin/jointfem '$(DECK)' $(BUILD)/figures

.PHONY: clean
clean:
	rm -rf $(BUILD) bin
