# Single changes of the source, and whether a test notices: make mutants [N=150] [SEED=1] [JOBS=1] [AGAIN=1]. See README.md
#
# Included by the Makefile, which sets BUILD, FC and the rules of the programs. AGAIN=1 tries anew what the last run left alive.

N     = 150
SEED  = 1
JOBS  = 1
AGAIN =
MUTANT_FLAGS = -O1 -fopenmp -w -fcheck=all,no-array-temps,no-recursion -ffpe-trap=invalid,zero

.PHONY: mutants mutants-run
mutants: $(COMPARE) $(QUERY)
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/mutants FFLAGS_CHECKED='$(MUTANT_FLAGS)' COMPARE=$(COMPARE) QUERY=$(QUERY) \
	   mutants-run

mutants-run: $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit $(UNIT_PROGRAM)
	@FC='$(FC)' FLAGS='$(FFLAGS_CHECKED)' LIBRARIES='$(LIBRARIES)' AGAIN='$(AGAIN)' JOBS='$(JOBS)' \
	   tests/mutants/run.sh $(BUILD) $(COMPARE) $(QUERY) $(N) $(SEED)
