# make demo    compare all techniques on the fence scene and say where the report is
# make test    everything that must hold before a change lands
# make bench   times on the fence scene
# make bench-cpu   what the processor does: instructions and allocations; needs valgrind
# make docs    the documents with tables: from their templates and docs/results, and from the rows of fidelity
# make results measures anew what docs/results holds of this machine; an hour in which it does nothing else
# make proof   a technique and a store of somebody else's keep the laws; part of `make test`
# make setup   what the first three do first: a Vulkan driver if the machine has none
# make msrv    the library with the lowest compiler that it promises, without features and with all
# make features   the library with each of its features by itself; installs cargo-hack where a registry can be reached
# make semver   what changed of the library's interface since the tag or commit SINCE; needs cargo-semver-checks
# make portability   every shader through a browser's compiler, pictures and laws on a second driver; needs Node

.PHONY: demo test proof bench bench-cpu docs results setup fmt clippy doc check-wasm features semver portability msrv deny golden

CARGO ?= cargo
export RUSTDOCFLAGS = -D warnings

demo: setup
	$(CARGO) run --release --bin antumbra -- compare fence --output report
	@echo "open report/index.html in a browser"

test: setup fmt clippy doc check-wasm
	$(CARGO) test --release --workspace
	$(MAKE) proof
	@echo "not tried here: a browser's compiler, and a second driver (make portability; needs Node)"

# With the versions of the workspace and what it has built. A bare `cargo test` in proof/ does as well.
proof: setup
	cp Cargo.lock proof/Cargo.lock
	cd proof && CARGO_TARGET_DIR=$(CURDIR)/target $(CARGO) test --release

bench: setup
	$(CARGO) run --release --bin antumbra -- bench fence --kernel 7 \
		--techniques hard pcf vsm esm csm.terms=4 csm

bench-cpu: setup
	@valgrind --version >/dev/null || { echo "bench-cpu: valgrind is needed (apt-get install valgrind)"; exit 1; }
	$(CARGO) bench --profile release -p antumbra-lab --bench cpu

docs:
	$(CARGO) run --release -p antumbra-docs --example docs
	$(CARGO) run --release -p antumbra-reproduce --bin antumbra-fidelity

# Runs a command that prints JSON and keeps that as a result file.
KEEP = target/release/examples/docs keep
PROGRAM = target/release/antumbra
results: setup
	$(CARGO) build --release --bin antumbra
	$(CARGO) build --release -p antumbra-docs --example docs
	$(KEEP) fence $(PROGRAM) bench fence --kernel 7 --rounds 9 --json --techniques all csm.terms=4 \
		pcf.taps=nearest pcf.taps=bilinear pcf.taps=merged esm.classifier=none esm.classifier=zmax spsm.layers=1 \
		esm.kernel=31 esm.sampling=summed vsm.sampling=summed csm.terms=4,sampling=summed
	$(KEEP) demo $(PROGRAM) compare fence --output target/demo --json
	$(KEEP) start-up env MESA_SHADER_CACHE_DISABLE=true $(PROGRAM) bench fence --rounds 1 --start-up --json
	$(KEEP) cpu $(CARGO) bench --quiet --profile release -p antumbra-lab --bench cpu -- --json
	$(MAKE) docs

setup:
	@sh scripts/setup.sh

fmt:
	$(CARGO) fmt --all --check
	cd proof && $(CARGO) fmt --check

clippy:
	$(CARGO) clippy --release --workspace --all-targets -- -D warnings

doc:
	$(CARGO) doc --release --workspace --no-deps

# The library with its page and what draws scenes must build for browsers; skipped, and said so, where the target is
# not installed.
check-wasm:
	@if rustc --print target-libdir --target wasm32-unknown-unknown 2>/dev/null | xargs test -d; then \
		$(CARGO) clippy --release -p antumbra --lib --example browser --target wasm32-unknown-unknown -- -D warnings && \
		$(CARGO) clippy --release -p antumbra-render --target wasm32-unknown-unknown -- -D warnings; \
	else \
		echo "wasm32-unknown-unknown is not installed: browser build not checked (rustup target add wasm32-unknown-unknown)"; \
	fi

SHADERS = target/portability
# Chromium's software driver: another compiler and another rasteriser than Mesa's.
SWIFTSHADER = target/swiftshader/vk_swiftshader_icd.json

# After `make test` this builds nothing: the same tests write what they check.
portability: setup
	@node --version >/dev/null && npm --version >/dev/null || { echo "portability: Node 20 or later is needed, with npm"; exit 1; }
	rm -rf $(SHADERS)
	ANTUMBRA_SHADERS=$(CURDIR)/$(SHADERS) $(CARGO) test --release --workspace --test portability
	ANTUMBRA_SHADERS=$(CURDIR)/$(SHADERS) $(CARGO) test --release --workspace --lib every_shader_is_portable
	cd portability && npm ci --silent && node check.mjs ../$(SHADERS)
	@if command -v $${CHROMIUM:-chromium} >/dev/null; then \
		cd portability && node browser.mjs ../$(SHADERS); \
	else \
		echo "Chromium is not installed: shaders not tried in a browser"; \
	fi
	@sh scripts/swiftshader.sh $(dir $(SWIFTSHADER))
	VK_DRIVER_FILES=$(CURDIR)/$(SWIFTSHADER) ANTUMBRA_ADAPTER=SwiftShader $(CARGO) test --release --workspace \
		--test golden --test laws

MSRV = $(shell sed -n 's/^rust-version = "\(.*\)"/\1/p' crates/antumbra/Cargo.toml)
msrv:
	@if rustup toolchain list 2>/dev/null | grep -q '^$(MSRV)'; then \
		for features in --no-default-features --all-features; do \
			$(CARGO) +$(MSRV) check -p antumbra --lib $$features --target-dir target/msrv || exit 1; \
		done; \
	else \
		echo "Rust $(MSRV) is not installed: the lowest compiler not tried (rustup toolchain install $(MSRV) --profile minimal)"; \
	fi

# Without features, with each by itself, and with all.
features:
	@if $(CARGO) hack --version >/dev/null 2>&1 || $(CARGO) install cargo-hack --locked; then \
		$(CARGO) hack check --release -p antumbra --lib --each-feature --optional-deps serde; \
	else \
		echo "cargo-hack is not to be had: features not tried by themselves"; \
	fi

# Until a version is published there is nothing to compare with but a commit: make semver SINCE=main
SINCE ?= $(shell git describe --tags --abbrev=0 2>/dev/null)
semver:
	@test -n "$(SINCE)" || { echo "semver: say since which tag or commit: make semver SINCE=…"; exit 1; }
	@$(CARGO) semver-checks --version >/dev/null 2>&1 || { echo "semver: cargo-semver-checks is needed (cargo install cargo-semver-checks --locked)"; exit 1; }
	$(CARGO) semver-checks --package antumbra --baseline-rev $(SINCE)

# Licences and advisories of all dependencies; needs cargo-deny.
deny:
	$(CARGO) deny check

# Writes the reference images anew; look at every one before committing it.
golden:
	ANTUMBRA_BLESS=1 $(CARGO) test --release -p antumbra --test golden
