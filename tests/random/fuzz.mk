# Fuzzing, and the programs with sanitizers that it runs too.

# those of `make sanitize`
ADDRESS   = $(BUILD)/sanitize/address
SANITIZED = -O1 -g -fbacktrace -fsanitize=address,undefined -fno-omit-frame-pointer

MINUTES = 5
SEED    = $(shell date +%s)
FROM    = 1

.PHONY: sanitized
sanitized:
	@$(MAKE) --no-print-directory -s BUILD=$(ADDRESS) BIN=$(ADDRESS) FFLAGS='$(SANITIZED)' $(ADDRESS)/jointfem $(ADDRESS)/jointfit

# make fuzz MINUTES=60 SEED=7; DECKS=100 in place of minutes, FROM=401: from that deck on
.PHONY: fuzz
fuzz: bin/jointfem bin/jointfit $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit sanitized
	@tests/random/fuzz.sh -s $(SEED) -f $(FROM) $(if $(DECKS),-n $(DECKS),-m $(MINUTES)) -a 4 $(BUILD)/fuzz \
	   release=bin/jointfem checked=$(BUILD)/checked/jointfem asan=$(ADDRESS)/jointfem

# make pairs N=5000 SEED=1: valid decks in which every pair of features meets; FROM=401: from that deck on
N = 1000

.PHONY: pairs
pairs: bin/jointfem
	@tests/random/pairs.sh -s $(SEED) -f $(FROM) -n $(N) bin/jointfem $(BUILD)/pairs
