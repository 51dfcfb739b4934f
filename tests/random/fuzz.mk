# Fuzzing, and the programs with sanitizers that it runs too.

# those of `make sanitize`
ADDRESS   = $(BUILD)/sanitize/address
SANITIZED = -O1 -g -fbacktrace -fsanitize=address,undefined -fno-omit-frame-pointer

MINUTES = 5
FROM    = 1
# defaults of these targets alone: those of make mutants are others
fuzz pairs: SEED = $(shell date +%s)
pairs: N = 1000

# $(call whole_number,NAMES): what the command line sets of these is a whole number, else nothing is made
without_digits = $(subst 0,,$(subst 1,,$(subst 2,,$(subst 3,,$(subst 4,,$(subst 5,,$(subst 6,,$(subst 7,,$(subst 8,,$(subst 9,,$(1)))))))))))
whole_number = $(foreach name,$(1),$(if $(filter command%,$(origin $(name))),$(if $(call without_digits,$($(name)))$(if \
   $($(name)),,blank),$(error $(name)=$($(name)): expected a whole number))))
$(call whole_number,MINUTES DECKS N SEED)

.PHONY: sanitized
sanitized:
	@$(MAKE) --no-print-directory -s BUILD=$(ADDRESS) BIN=$(ADDRESS) FFLAGS='$(SANITIZED)' $(ADDRESS)/jointfem $(ADDRESS)/jointfit

# make fuzz MINUTES=60 SEED=7; DECKS=100 in place of minutes, FROM=401: from that deck on
.PHONY: fuzz
fuzz: bin/jointfem bin/jointfit $(BUILD)/checked/jointfem $(BUILD)/checked/jointfit sanitized
	@tests/random/fuzz.sh -s '$(SEED)' -f '$(FROM)' $(if $(DECKS),-n '$(DECKS)',-m '$(MINUTES)') -a 4 $(BUILD)/fuzz \
	   release=bin/jointfem checked=$(BUILD)/checked/jointfem asan=$(ADDRESS)/jointfem

# make pairs N=5000 SEED=1: valid decks in which every pair of features meets; FROM=401: from that deck on
.PHONY: pairs
pairs: bin/jointfem
	@tests/random/pairs.sh -s '$(SEED)' -f '$(FROM)' -n '$(N)' bin/jointfem $(BUILD)/pairs
