# The programs of the benchmark, and `make bench`. CHOLMOD is measured where its header is installed (libsuitesparse-dev), PARDISO where
# MKLROOT names MKL.
#
# The including makefile sets CC, FC, FFLAGS_RELEASE, BUILD, RELEASE_OBJECTS and LIBRARIES, and has a rule for bin/jointfem.

BENCH_FOLDER   := $(BUILD)/bench
BENCH_CHOLMOD  := $(wildcard /usr/include/suitesparse/cholmod.h /usr/local/include/suitesparse/cholmod.h)
BENCH_MPI      := $(filter mpi,$(MODELS))
BENCH_PROGRAMS := $(BENCH_FOLDER)/dgemm_rate $(if $(BENCH_MPI),$(BENCH_FOLDER)/partition_plan) \
                  $(if $(BENCH_CHOLMOD)$(MKLROOT),$(BENCH_FOLDER)/write_matrix) $(if $(BENCH_CHOLMOD),$(BENCH_FOLDER)/cholmod_once) \
                  $(if $(MKLROOT),$(BENCH_FOLDER)/pardiso_once)

.PHONY: bench
bench: bin/jointfem bin/jointfit $(BENCH_PROGRAMS) $(BENCH_MPI)
	@tests/bench/bench.sh bin/jointfem $(BENCH_FOLDER) $(MODELS)

$(BENCH_FOLDER)/dgemm_rate $(BENCH_FOLDER)/write_matrix $(BENCH_FOLDER)/partition_plan: $(BENCH_FOLDER)/%: tests/bench/%.f90 $(RELEASE_OBJECTS)
	@mkdir -p $(@D)
	$(FC) $(FFLAGS_RELEASE) -I$(BUILD)/release -o $@ $< $(RELEASE_OBJECTS) $(LIBRARIES)

$(BENCH_FOLDER)/cholmod_once: tests/bench/cholmod_once.c
	@mkdir -p $(@D)
	$(CC) -O2 -std=c11 -Wall -Wextra -o $@ $< -Wl,--no-as-needed -lopenblas -lcholmod -ldl -lm

$(BENCH_FOLDER)/pardiso_once: tests/bench/pardiso_once.c
	@mkdir -p $(@D)
	$(CC) -O2 -std=c11 -D_POSIX_C_SOURCE=199309L -Wall -Wextra -o $@ $< -L$(MKLROOT)/lib/intel64 -L$(MKLROOT)/lib \
	   -Wl,-rpath,$(MKLROOT)/lib/intel64:$(MKLROOT)/lib -lmkl_rt -lm
