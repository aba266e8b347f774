# Two commands for a newcomer: `make demo` and `make test`. The work is done by scripts/, which say what they do and skip what is done.
.DEFAULT_GOAL := help
.PHONY: help demo test build bench format lint clean

help: ## list these targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "make %-8s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: ## install what is missing, build, render two pictures and compare the structures (out/)
	@scripts/demo

test: ## install what is missing, build everything and run every test
	@scripts/test

build: ## build everything into build/release (PRESET=debug, asan, tsan or coverage for another)
	@scripts/build $(or $(PRESET),release)

bench: ## build the benchmarks and run Grove beside Embree (BENCH=--page for all of docs/performance.md, or --quick and other options of grove_rival_bench)
	@scripts/bench $(BENCH)

format: ## format every source with clang-format
	@scripts/format

lint: ## check format, shell scripts, lone headers and clang-tidy's findings; changes nothing
	@scripts/lint

clean: ## remove build/ and out/
	rm -rf build out
