# Two commands do all the set-up: `make demo` and `make test`. Both install what the system lacks (as root or through
# sudo), build, and run. A second run installs nothing.

BUILD_PACKAGES := libopencv-calib3d-dev libopencv-video-dev clang mesa-vulkan-drivers libvulkan1 pkg-config g++
# The tests open the report in a headless browser. Ubuntu packages none (only a snap): there, that one test is skipped.
TEST_PACKAGES := $(shell . /etc/os-release 2>/dev/null; [ "$$ID" = debian ] && echo chromium)

EXAMPLES := $(basename $(notdir $(sort $(wildcard examples/*.rs))))

# OpenCV's folders on Debian and Ubuntu, whatever the architecture; a variable that is already set wins.
MULTIARCH := $(shell uname -m)-linux-gnu
export OPENCV_INCLUDE_PATHS ?= /usr/include/opencv4,/usr/include/$(MULTIARCH)/opencv4
export OPENCV_LINK_PATHS ?= /usr/lib/$(MULTIARCH)

.PHONY: demo test accuracy calibrate calibrate-check fuzz bench lint packages

# Install, build, render and navigate both missions, write out/demo/report.html.
demo: packages
	cargo run -- demo --out out/demo

# Install, build, run every test and every example.
test: packages
	@.ci/install $(TEST_PACKAGES)
	cargo test
	@for example in $(EXAMPLES); do echo "== $$example"; cargo run --quiet --example $$example || exit 1; done

# Long accuracy campaigns against their bounds, as a table.
accuracy: packages
	cargo test --test main accuracy_ -- --ignored --nocapture --test-threads=1

# The noise model of the front end, fitted to scenes of its own: prints old and new numbers, writes
# src/vision/noise_model/noise_model.toml. Rendered scenes are kept: run again, it goes on where it was interrupted.
calibrate: packages
	OPNAV_CALIBRATION_DATE=$$(date +%F) cargo test --test main calibration::calibrate -- --exact --ignored --nocapture

# How consistent the noise model is on further scenes, which had no part in it (OPNAV_NOISE_MODEL: another one beside it).
calibrate-check: packages
	cargo test --test main calibration::judge_on_held_out_scenes -- --exact --ignored --nocapture

# Every reader of files against damaged ones, ten minutes each (FUZZ_SECONDS), from a new seed each time (FUZZ_SEED).
fuzz: packages
	cargo test --test main fuzz:: -- --ignored --nocapture

# Criterion benchmarks of the renderer and the front end.
bench: packages
	cargo bench

# Formatting, lints and documentation: everything, and the feature sets that leave rooms out.
lint: packages
	cargo fmt --all --check
	cargo clippy --all-targets -- -D warnings
	cargo clippy --all-targets --no-default-features -- -D warnings
	cargo clippy --all-targets --no-default-features --features render,cli -- -D warnings
	cargo clippy --all-targets --no-default-features --features vision,cli -- -D warnings
	cargo clippy --no-default-features --features scene -- -D warnings
	cargo clippy --no-default-features --features report,cli -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps

packages:
	@.ci/install $(BUILD_PACKAGES)
	@command -v cargo >/dev/null || { echo "Rust is missing: get it from https://rustup.rs and run make again." >&2; exit 1; }
