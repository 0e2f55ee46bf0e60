# Byte code makes each of the many starts of the command in the tests 0.4 s shorter.
unexport PYTHONDONTWRITEBYTECODE
PYTHON ?= python3
BIN := .venv/bin
READY := .venv/.ready
# One more than there are cores, since some tests wait.
WORKERS ?= $(shell $(PYTHON) -c "import os; print((os.cpu_count() or 1) + 1)")

.DEFAULT_GOAL := help
.PHONY: help setup demo test test-docs test-slow test-studio test-converters web web-check data data-check owl-jars elk-jars fuseki-jar sssom-check-env docs sbom release-check audit fuzz lint types layers accuracy accuracy-check wheel compatibility lock scene clean

help: ## Show this list
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /\t/' | expand -t 12

setup: $(READY) ## Create .venv with all development dependencies

$(READY): requirements/dev.txt pyproject.toml
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --require-hashes --no-deps --requirement requirements/dev.txt
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@

demo: $(READY) ## Build the knowledge graph of the built-in kitchen and ask it three questions
	@mkdir -p build
	$(BIN)/usd2kg demo -o build/kitchen.ttl

test: $(READY) ## Run the tests
	$(BIN)/python -m pytest -q -n $(WORKERS) --dist worksteal

test-slow: $(READY) ## Run the slow tests
	$(BIN)/python -m pytest -q -m slow

test-docs: $(READY) ## Run the code blocks of the documentation; list those that are not run, with the reasons
	$(BIN)/python -m pytest -q -n auto --dist load -m docs tests
	$(BIN)/python -m tests.doc_counts

build/converters/.ready: requirements/converters.txt requirements/robots.txt
	$(PYTHON) -m venv build/converters
	build/converters/bin/python -m pip install --quiet --require-hashes --no-deps --requirement requirements/converters.txt \
	  --requirement requirements/robots.txt
	@touch $@

test-converters: $(READY) build/converters/.ready ## Run the tests of URDF and MJCF with the converters, in build/converters; needs Python 3.11 or 3.12
	PATH="$(CURDIR)/build/converters/bin:$$PATH" USD2KG_CONVERTERS="$(CURDIR)/build/converters" \
	  $(BIN)/python -m pytest -q -n auto tests/convert/test_robots.py tests/convert/test_robot_packages.py

test-studio: $(READY) web ## Run the tests of the studio, and those of its page and the query page in Chromium (CHROMIUM, or on the path)
	$(BIN)/python -m pytest -q -n auto --dist loadfile -m studio tests/studio tests/endpoint

web/node_modules: web/package-lock.json
	cd web && npm ci --no-audit --no-fund
	@touch $@

web: web/node_modules ## Build the page of the studio; needs Node.js 20
	cd web && npm run --silent build -- --logLevel warn

web-check: web/node_modules ## Check style and types of the page, and run its unit tests
	cd web && npm run --silent check && npm test --silent

data: $(READY) ## Build the package data in src/usd2kg/data from knowledge/
	$(BIN)/python -m tools.build_data

data-check: $(READY) ## Check that the package data is up to date with knowledge/
	$(BIN)/python -m tools.build_data --check

owl-jars: ## Download the OWL API and HermiT into build/owl, for make test-slow; needs Java 17 and Maven
	mvn -q -B -f tools/owl/pom.xml dependency:copy-dependencies -DoutputDirectory=$(CURDIR)/build/owl

build/supply/bin/cyclonedx-py: requirements/supply.txt
	$(PYTHON) -m venv build/supply
	build/supply/bin/python -m pip install --quiet --require-hashes --no-deps --requirement requirements/supply.txt

sbom: build/supply/bin/cyclonedx-py ## Write the bill of materials (CycloneDX) of dependencies, extras and pages into dist
	@mkdir -p dist build/sbom
	for part in run extras; do build/supply/bin/cyclonedx-py requirements requirements/$$part.txt --pyproject pyproject.toml \
	  --mc-type library --output-reproducible --output-format JSON --output-file build/sbom/$$part.json || exit 1; done
	$(PYTHON) -m tools.merge_sbom build/sbom/run.json build/sbom/extras.json web/package-lock.json dist/usd2kg.cdx.json

release-check: wheel build/supply/bin/cyclonedx-py ## Build the sdist, too, and check both for publication
	$(BIN)/uv build --quiet --sdist --no-build-isolation --python $(BIN)/python
	build/supply/bin/twine check --strict dist/*.whl dist/*.tar.gz

audit: build/supply/bin/cyclonedx-py ## Look for known vulnerabilities of all pinned dependencies; asks the registries
	build/supply/bin/pip-audit --disable-pip --require-hashes --requirement requirements/run.txt
	build/supply/bin/pip-audit --disable-pip --require-hashes --requirement requirements/extras.txt
	build/supply/bin/pip-audit --disable-pip --require-hashes --requirement requirements/dev.txt
	cd web && npm audit --omit=dev

build/docs/bin/mkdocs: requirements/docs.txt
	$(PYTHON) -m venv build/docs
	build/docs/bin/python -m pip install --quiet --require-hashes --no-deps --requirement requirements/docs.txt

docs: build/docs/bin/mkdocs ## Build the site of the documentation into build/site and check its links
	NO_MKDOCS_2_WARNING=1 build/docs/bin/mkdocs build --quiet --strict
	build/docs/bin/python tools/check_site.py build/site

sssom-check-env: ## Install the reference implementation of SSSOM into build/sssom, for make test-slow
	$(PYTHON) -m venv build/sssom
	build/sssom/bin/python -m pip install --quiet --require-hashes --no-deps --requirement requirements/sssom.txt

elk-jars: ## Download ELK into build/elk, for usd2kg validate --reasoner elk; needs Java 17 and Maven
	mvn -q -B -f tools/elk/pom.xml dependency:copy-dependencies -DoutputDirectory=$(CURDIR)/build/elk

fuseki-jar: ## Download Apache Jena Fuseki into build/fuseki, for tests of remote stores; needs Java 17 and Maven
	mvn -q -B dependency:copy -Dartifact=org.apache.jena:jena-fuseki-server:5.6.0 -DoutputDirectory=$(CURDIR)/build/fuseki

fuzz: $(READY) ## Fuzz stages, the whole chain and other inputs, an hour each; keep failing files in build/fuzz
	$(BIN)/python -m tests.scene.fuzz --seconds 3600 --keep build/fuzz

lint: $(READY) ## Check style and formatting
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(READY) ## Check types
	$(BIN)/mypy

layers: $(READY) ## Check that packages import only lower layers
	$(BIN)/lint-imports --no-logo

accuracy: $(READY) ## Measure the offline grounders on all scenes with gold labels and store the figures
	$(BIN)/python benchmarks/accuracy/run.py

accuracy-check: $(READY) ## Check the stored figures; list the scenes that cannot be measured
	$(BIN)/python benchmarks/accuracy/run.py --check

wheel: $(READY) web ## Build the wheel into dist/, with the page of the studio
	@rm -rf dist
	$(BIN)/uv build --quiet --wheel --no-build-isolation --python $(BIN)/python

compatibility: wheel ## Try the wheel with Python 3.11 to 3.13 (PYTHONS), oldest and newest dependencies
	$(BIN)/python -m tools.try_wheel dist/*.whl $(PYTHONS)

lock: $(READY) ## Pin the dependencies of pyproject.toml in requirements/, with hashes
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-header --no-annotate \
	  --group dev --output-file requirements/dev.txt pyproject.toml
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-header --no-annotate \
	  --output-file requirements/run.txt pyproject.toml
	$(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-header --no-annotate \
	  --all-extras --constraint requirements/dev.txt --output-file requirements/extras.txt pyproject.toml
	printf 'cyclonedx-bom\npip-audit\ntwine\n' | $(BIN)/uv pip compile --quiet --universal --python-version 3.11 \
	  --generate-hashes --no-header --no-annotate --output-file requirements/supply.txt -
	printf 'black\nmkdocs\nmkdocs-material\nmkdocstrings-python\n' | $(BIN)/uv pip compile --quiet --universal --python-version 3.11 \
	  --generate-hashes --no-header --no-annotate --output-file requirements/docs.txt -
	printf 'mujoco-usd-converter\nurdf-usd-converter\n' | $(BIN)/uv pip compile --quiet --universal --python-version 3.11 \
	  --generate-hashes --no-header --no-annotate --output-file requirements/converters.txt -
	printf 'airo-models\ngymnasium-robotics\n' | $(BIN)/uv pip compile --quiet --universal --python-version 3.11 --no-deps \
	  --generate-hashes --no-header --no-annotate --output-file requirements/robots.txt -
	echo sssom | $(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes --no-header \
	  --no-annotate --output-file requirements/sssom.txt -

scene: $(READY) ## Write the demo kitchen and the benchmark scenes from their scripts
	$(BIN)/python -m scenes

clean: ## Remove build outputs and .venv
	rm -rf .venv build dist
