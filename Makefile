# Every verb does its own set-up: make demo and make test work on a fresh Debian 12 with Rust, gcc
# and Python. CI calls only these verbs.

PYTHON ?= /usr/bin/python3
PREFIX ?= /usr/local
SECONDS ?= 60
HOST = $(shell rustc -vV | sed -n 's/^host: //p')
VERSION := $(shell sed -n 's/^version = "\(.*\)"$$/\1/p' Cargo.toml | head -n 1)

EXAMPLE := examples/compressor_blade
DEMO := build/demo
TEST_PYTHON := build/venv/bin/python
RUFF := build/venv/bin/ruff
PYTHON_SOURCES := freecad_workbench freecad_workbench/bladesmith tests/python benches cmake docs tools

export PYTHON DESTDIR

.PHONY: help setup setup-run build test test-rust test-python fuzz awkward-files demo docs lint format bench dist install \
    uninstall clean

help:
	@echo "make demo     morph a compressor blade; leaves STEP, report and pictures in $(DEMO)"
	@echo "make test     run every test"
	@echo "make fuzz     call the kernel with arbitrary arguments for SECONDS (now $(SECONDS))"
	@echo "make build    build the library (target/release)"
	@echo "make install  install library and command below PREFIX (now $(PREFIX))"
	@echo "make uninstall  remove what make install put below PREFIX"
	@echo "make lint     check format and lints"
	@echo "make format   put sources into shape"
	@echo "make docs     draw the pictures of the documentation and build its pages, with a link check"
	@echo "make bench    measure times and memory"
	@echo "make dist     pack the sources, and the add-on for FreeCAD, into build/"
	@echo "make setup    install what the tests need"

setup:
	@bash .ci/setup test

setup-run:
	@bash .ci/setup run

build: setup-run
	cargo build --release --lib --locked

test: setup build lint test-rust test-python
	@echo "All tests passed."

test-rust: setup
	cargo test --release --locked

# Under the address sanitizer where a nightly compiler is installed.
fuzz: setup
	@if cargo +nightly --version >/dev/null 2>&1; then \
	    set -- env RUSTFLAGS=-Zsanitizer=address cargo +nightly test --target $(HOST) --target-dir build/fuzz; \
	else \
	    set -- cargo test; \
	fi; \
	BLADESMITH_FUZZ_SECONDS=$(SECONDS) "$$@" --release --locked --test fuzz -- --nocapture

awkward-files: setup
	@cargo test --release --locked --quiet --test rooms p5_files >/dev/null

test-python: setup build awkward-files
	cd tests/python && ../../$(TEST_PYTHON) -m unittest discover --start-directory . --pattern 'test_*.py'

demo: build
	@mkdir -p $(DEMO)
	@echo "Morphing $(EXAMPLE) from hot to cold ..."
	@freecad_workbench/bladesmith morph $(EXAMPLE)/hot.step.gz $(EXAMPLE)/blade.frd.gz \
	    --mesh $(EXAMPLE)/blade.inp.gz --factor -1 --output $(DEMO)/cold.step \
	    --json $(DEMO)/report.json --report $(DEMO)/report
	@echo "The results are in $(abspath $(DEMO)):"
	@echo "  cold.step           the cold solid"
	@echo "  report.json         all figures"
	@echo "  report/report.html  the page, and its pictures beside it"

docs: build
	@bash .ci/setup docs
	cd tests/python && ../../$(TEST_PYTHON) -m unittest \
	    test_window.Window.test_a_users_walk_with_the_blade test_result_window
	cd build/screenshots && cp $(notdir $(shell grep -oh 'pictures/[a-z0-9-]*\.png' docs/*.md | sort -u)) ../../docs/pictures/
	build/docs-venv/bin/python -m mkdocs build --strict --quiet
	@echo "The pages are in $(abspath build/docs)/index.html"

lint: setup
	cargo fmt --check
	cargo clippy --release --locked --all-targets --quiet -- -D warnings
	$(RUFF) check --quiet $(PYTHON_SOURCES)
	$(RUFF) format --check --quiet $(PYTHON_SOURCES)

format: setup
	cargo fmt
	$(RUFF) format --quiet $(PYTHON_SOURCES)

bench: build
	$(PYTHON) benches/morph_command.py

dist: build
	@mkdir -p build
	git archive --format=tar --prefix=bladesmith-$(VERSION)/ HEAD | gzip -9n > build/bladesmith-$(VERSION).tar.gz
	@echo "build/bladesmith-$(VERSION).tar.gz"
	@$(PYTHON) cmake/addon.py target/release/libbladesmith.so build

install: build
	cmake/install.sh $(PREFIX)

uninstall:
	cmake/uninstall.sh $(PREFIX)

clean:
	rm -rf build target
