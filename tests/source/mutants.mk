# Single changes of the source, and whether a test notices: make mutants [N=150] [SEED=1] [JOBS=1] [AGAIN=1]. See README.md
#
# Included by the Makefile, which sets BUILD, FC and the rules of the programs. AGAIN=1 tries anew what the last run left alive.

JOBS  = 1
AGAIN =
mutants mutants-run: N    = 150
mutants mutants-run: SEED = 1
$(call whole_number,N SEED JOBS)
MUTANT_FLAGS = -O1 -fopenmp -w -fcheck=all,no-array-temps,no-recursion -ffpe-trap=invalid,zero

.PHONY: mutants mutants-run
mutants: bin/jointfem bin/jointfit $(COMPARE) $(QUERY)
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/mutants FFLAGS_CHECKED='$(MUTANT_FLAGS)' COMPARE=$(COMPARE) QUERY=$(QUERY) \
	   RELEASE=$(BUILD)/release mutants-run

mutants-run: $(CHECKED_LIBRARY) $(UNIT_PROGRAM)
	@FC='$(FC)' FLAGS='$(FFLAGS_CHECKED)' LIBRARIES='$(LIBRARIES)' AGAIN='$(AGAIN)' JOBS='$(JOBS)' \
	   tests/source/mutants.sh $(BUILD) $(RELEASE) $(COMPARE) $(QUERY) '$(N)' '$(SEED)'
