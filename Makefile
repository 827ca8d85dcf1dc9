# Everything runs in .venv, which is made when it is missing or older than requirements.lock; what only some
# targets need, requirements-test.lock and its like, is added by the first of them.
PYTHON ?= python3
SIZE   ?= paper
ARGS   ?=
# of a Dask cluster on which the cases of studies run: tcp://host:port
SCHEDULER ?=

# what is wrong is said before anything is set up; what is typed has spaces behind backslashes
variables := SIZE ARGS SCHEDULER SCENE METHOD ROWS NUMBERS TEXT PYTHON
near = $(shell $(PYTHON) -c 'import difflib, sys; print(*difflib.get_close_matches(sys.argv[1].upper(), sys.argv[2:], 1))' $1 $(variables))
all = there are $(variables); numbers of a scene go into NUMBERS="ra=5000 pr=0.7"
$(foreach one,$(subst :,=,$(subst +,=,$(subst \$() ,_,$(MAKEOVERRIDES)))),$(foreach name,$(firstword $(subst =, ,$(one))),\
	$(if $(filter $(variables) %_NUM_THREADS,$(name)),,\
	$(error no variable is called $(name); $(or $(addprefix near to it is ,$(call near,$(name))),$(all))))))
$(if $(filter quick paper fine,$(SIZE)),,$(error unknown size '$(SIZE)': choose one of quick, paper, fine, as in SIZE=quick))
$(if $(SCHEDULER),$(if $(and $(filter tcp://% tls://% ws://% wss://%,$(SCHEDULER)),$(word 3,$(subst :, ,$(SCHEDULER)))),,\
	$(error SCHEDULER=$(SCHEDULER) is no address of a Dask scheduler: give tcp://host:port)))

run     := .venv/bin/python
# a study is a folder that makes a STUDY; the others serve them
studies := $(patsubst studies/%/__init__.py,%,$(shell grep -l '^STUDY = ' studies/*/__init__.py))
# studies of former versions and the ones that they are part of
renamed := bodies:conservation motions:conservation transport:operators nested:operators fluctuations:noise dpd:noise speed:cost scenes:cost

# needs no more than requirements.lock, and Dask where a cluster computes
study := .venv/ready $(if $(SCHEDULER),.venv/ready-cluster)

export SIZE SCHEDULER
export PYTHONPATH := $(CURDIR)
# packages come without Python's caches, which the first run writes
export PYTHONDONTWRITEBYTECODE :=

.DEFAULT_GOAL := help
.NOTPARALLEL:
.DELETE_ON_ERROR:
.PHONY: help env solve judge words studies report films test lint types notebooks executed lab bench worker locks clean $(studies:%=study-%) $(studies:%=figures-%) study- figures-

# a line for each name that % stands for
help:  ## this list
	@echo 'make TARGET [SIZE=quick|paper|fine] [ARGS="--workers 1"] [SCHEDULER=tcp://host:port] [PYTHON=python3]'
	@awk -v names='$(studies)' '{ sub(/^[$$][(].*[)]: /, "") } /^[a-z%-]+:.*  ## / { \
		text = $$0; sub(/.*  ## /, "", text); target = $$1; sub(/:$$/, "", target); \
		n = target ~ /%/ ? split(names, name, " ") : 1; \
		for (i = 1; i <= n; i++) { one = target; sub(/%/, name[i], one); printf "  %-22s%s\n", one, text } }' Makefile
	@echo '  ARGS="--only TEXT" runs the cases of a study with this text in their label, such as the name of a variant'
	@echo '  ARGS="--only NAME --rows 16 --seeds 1" tries out a method in results/own (study-rb)'
	@echo '  SIZE=quick writes to results/quick'

$(studies:%=study-%): study-%: $(study)  ## cases, tables, figures, verdicts of a study; goes on where it stopped
	$(run) -m studies $* $(ARGS)

$(studies:%=figures-%): figures-%: .venv/ready  ## its figures again, from its tables only
	$(run) -m studies $* figures $(ARGS)

# any other name, before something is set up for it
study-% figures-%:
	@echo 'no study $*$(patsubst $*:%, any more: it is part of %,$(filter $*:%,$(renamed))): there are $(studies)' >&2; exit 2
study- figures-:
	@echo 'no study named: there are $(studies)' >&2; exit 2

env: .venv/ready  ## set up .venv and nothing else

# every table and figure of the size; then what is made from tables: of size quick the page alone, in results/quick
studies: $(studies:%=study-%) $(if $(filter quick,$(SIZE)),,films executed) report  ## all studies, notebooks, films, the page: hours

# of one solution: names of studies/build/words.csv; several methods, rows, numbers of the scene in quotes
SCENE   ?= rayleigh-benard
METHOD  ?= fixed-lattice
ROWS    ?= 16
NUMBERS ?=
comma := ,
spaced = $(subst $(comma), ,$1)
solve: .venv/ready  ## K, Nu and a picture: make solve SCENE=cavity METHOD="grid spam" ROWS="16 32" NUMBERS="ra=5000 pr=0.7"
	$(run) -m studies.front $(SCENE) $(call spaced,$(METHOD)) --rows $(call spaced,$(ROWS)) $(if $(NUMBERS),--numbers $(call spaced,$(NUMBERS))) $(ARGS)

# a class of one's own, module:Class, or a name as above; ARGS="--rows 8 12" is a ladder of half a minute
judge: .venv/ready  ## a page on how good a method of your own is, and an error if no rung is passed: make judge METHOD=examples.your_method:Cells
	$(run) -m studies.judge $(METHOD) $(ARGS)

words: .venv/ready  ## every name of a method, scene, quantity, explained; TEXT=wendland shows some
	$(run) -m studies.build $(TEXT)

report: .venv/ready-films  ## results/equations.md, tables.md, index.html: one page of answers, pictures, verdicts, tables
	$(if $(filter quick,$(SIZE)),,$(run) -m studies.report equations)
	$(if $(filter quick,$(SIZE)),,$(run) -m studies.report tables)
	$(run) -m studies.report $(if $(filter quick,$(SIZE)),--out results/quick)

films: .venv/ready-films  ## the films of the report, some minutes
	$(run) -m studies.report films

# two processes, each with one thread for linear algebra; tests/conftest.py says what stays in one
test: export OMP_NUM_THREADS ?= 1
test: .venv/ready-test .venv/ready-cluster .venv/ready-films  ## the tests, on two cores
	$(run) -m pytest -n 2 --dist loadfile --no-loadscope-reorder $(ARGS)

lint: .venv/ready-test  ## ruff
	$(run) -m ruff check .

types: .venv/ready-test  ## mypy on the public functions
	$(run) -m mypy

notebooks: .venv/ready-lab  ## run every notebook in results/, and leave it as it is
	@if ls results/*.ipynb >/dev/null 2>&1; then $(run) -m pytest --nbmake results/*.ipynb; \
	else echo 'no notebooks in results/ yet'; fi

executed: .venv/ready-lab  ## run every notebook in results/, and keep what comes out
	@for one in results/*.ipynb; do echo "$$one"; $(run) -m jupyter execute --inplace "$$one" || exit 1; done

lab: .venv/ready-lab  ## open the notebooks in results/ in a browser
	$(run) -m jupyter lab results/rb.ipynb $(ARGS)

# beside codes that compute on one core
bench: export OPENBLAS_NUM_THREADS = 1
bench: .venv/ready-bench  ## speed, beside public codes, in one run
	$(run) -m bench.spam_speed $(ARGS)
	$(run) -m bench.points_speed
	$(run) -m bench.dpd_speed $(ARGS)

# a name that is no target
.DEFAULT:
	@echo 'nothing is called $@: make lists what there is' >&2; exit 2

# one case at a time, with one thread each
worker: export OMP_NUM_THREADS = 1
worker: export OPENBLAS_NUM_THREADS = 1
worker: export MKL_NUM_THREADS = 1
worker: export NUMBA_NUM_THREADS = 1
worker: $(if $(SCHEDULER),$(study))  ## lend this machine to the cluster at SCHEDULER; ARGS="--nworkers 8" lends 8 cores of it
	@test -n '$(SCHEDULER)' || { echo 'make worker SCHEDULER=tcp://host:port: the address that dask scheduler prints' >&2; exit 2; }
	$(run) -m dask worker $(SCHEDULER) --nthreads 1 --no-dashboard $(ARGS)

clean:  ## remove caches; .venv and finished cases (results/raw) stay
	rm -rf .numba_cache .pytest_cache .mypy_cache .ruff_cache
	find . -name __pycache__ -not -path './.venv/*' -prune -exec rm -rf {} +

# Set up beside and renamed, one at a time: a study that runs keeps its environment meanwhile. Python compiles a
# library when it is imported first: most of them are not. Bars of progress are for people, a pipe gets lines.
install = -m pip install --disable-pip-version-check --only-binary :all: --no-compile \
	$$(test -t 1 || echo --progress-bar off)
locked = $(PYTHON) -c 'import fcntl, subprocess, sys; lock = open(".venv-lock", "w"); fcntl.flock(lock, fcntl.LOCK_EX); \
	sys.exit(subprocess.call(["sh", "-ec", sys.argv[1]]))'

.venv/ready: requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and \
		"Python %d.%d is too old, 3.11 is needed: make PYTHON=python3.11 ..." % sys.version_info[:2])'
	@test ! -L .venv || { echo '.venv is a link, and what it leads to would be emptied: make env there, then touch .venv/ready' >&2; exit 2; }
	@$(locked) 'if test $@ -nt $<; then exit; fi; \
	echo "Setting up .venv, once: 0.5 GB, about a minute"; \
	$(PYTHON) -m venv --clear .venv-new; \
	.venv-new/bin/python $(install) -r $<; \
	.venv-new/bin/python -m pip uninstall --quiet --yes setuptools; \
	find .venv-new -type d -name tests -prune -exec rm -rf {} +; \
	grep -rIl "[.]venv-new" .venv-new/bin | xargs sed -i.bak "s/[.]venv-new/.venv/g"; rm .venv-new/bin/*.bak; \
	touch .venv-new/ready; rm -rf .venv-old; if test -e .venv; then mv .venv .venv-old; fi; \
	mv .venv-new .venv; rm -rf .venv-old'	# 75 MB that nothing here needs: setuptools of Python 3.11, tests of the packages

.venv/ready-%: requirements-%.lock .venv/ready
	@echo 'Adding $< to .venv, once'
	@$(locked) 'if ! test $@ -nt $<; then $(run) $(install) -r $<; touch $@; fi'

# versions stay; those of a lock that was emptied become the newest that fit the others
locks: locking := uv pip compile -q --universal --python-version 3.11 --generate-hashes --no-header --no-annotate
locks:  ## requirements*.lock again, from pyproject.toml; needs uv
	$(locking) pyproject.toml -o requirements.lock
	@for one in $(patsubst requirements-%.lock,%,$(wildcard requirements-*.lock)); do \
	$(PYTHON) -c "import tomllib; project = tomllib.load(open('pyproject.toml', 'rb'))['project']; \
		print(*project['optional-dependencies']['$$one'], sep='\n')" \
	| $(locking) $(patsubst %,-c %,$(wildcard requirements*.lock)) - -o requirements-$$one.lock || exit 1; done
