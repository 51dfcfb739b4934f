# Which lines of src the tests run: make coverage. Included by the Makefile, which sets BUILD and the rules of the programs.
#
# The checked build is made anew under $(BUILD)/coverage with counters in place of checks, and takes the part of both programs. The parts
# that run the decks of the manuals are left out: a third of the time, in which ten lines of 26,000 run that no other part reaches.

COVERAGE_WITHOUT = other processors|run-time checks|queries|itself|themselves|tools of make|tour|verification manual|of the manuals

COVERAGE_FLAGS = -O0 --coverage -fopenmp -fno-backtrace $(WARNINGS)

.PHONY: coverage coverage-run
coverage: $(COMPARE) $(QUERY)
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/coverage FFLAGS_CHECKED='$(COVERAGE_FLAGS)' \
	   COMPARE=$(COMPARE) QUERY=$(QUERY) coverage-run

coverage-run: $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit $(UNIT_PROGRAM)
	@find $(BUILD) -name '*.gcda' -delete
	@-MAKE='$(MAKE)' WITHOUT='$(COVERAGE_WITHOUT)' tests/run_all.sh $(BUILD)/checked/jointfem $(BUILD)/checked/jointfem \
	   $(COMPARE) $(QUERY) $(BUILD) > $(BUILD)/tests.log 2>&1; tail -n 1 $(BUILD)/tests.log
	@tests/source/coverage.sh $(BUILD)/checked src tests/source/unreached.txt
