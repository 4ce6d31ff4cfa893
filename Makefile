# make demo    compare all techniques on the fence scene and say where the report is
# make test    everything that must hold before a change lands
# make bench   times on the fence scene
# make setup   what the two above do first: a Vulkan driver if the machine has none

.PHONY: demo test bench setup fmt clippy doc check-wasm deny golden

CARGO ?= cargo
export RUSTDOCFLAGS = -D warnings

demo: setup
	$(CARGO) run --release --bin antumbra -- compare fence --output report
	@echo "open report/index.html in a browser"

test: setup fmt clippy doc check-wasm
	$(CARGO) test --release --workspace

bench: setup
	$(CARGO) run --release --bin antumbra -- bench fence --kernel 7 \
		--techniques hard pcf vsm esm csm.terms=4 csm

setup:
	@sh scripts/setup.sh

fmt:
	$(CARGO) fmt --all --check

clippy:
	$(CARGO) clippy --release --workspace --all-targets -- -D warnings

doc:
	$(CARGO) doc --release --workspace --no-deps

# The library must build for browsers; skipped, and said so, where the target is not installed.
check-wasm:
	@if rustc --print target-libdir --target wasm32-unknown-unknown 2>/dev/null | xargs test -d; then \
		$(CARGO) check --release -p antumbra --target wasm32-unknown-unknown; \
	else \
		echo "wasm32-unknown-unknown is not installed: browser build not checked (rustup target add wasm32-unknown-unknown)"; \
	fi

# Licences and advisories of all dependencies; needs cargo-deny.
deny:
	$(CARGO) deny check

# Writes the reference images anew; look at every one before committing it.
golden:
	ANTUMBRA_BLESS=1 $(CARGO) test --release -p antumbra --test golden
