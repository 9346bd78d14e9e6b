# Each verb works alone on a fresh Debian 12 machine: it installs what packages.txt lists (only what
# is missing), configures and builds.
.PHONY: configure build demo test check fuzz fuzz-long package bench deps experiment reference
.DEFAULT_GOAL := build

SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo -E)
JOBS := $(shell nproc)
CAIRN := build/release/bin/cairn

deps:
	@missing=""; for p in $$(grep -v '^#' packages.txt); do \
	  [ "$$(dpkg-query -W -f='$${db:Status-Status}' $$p 2>/dev/null)" = installed ] || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then echo "installing:$$missing"; \
	  $(SUDO) apt-get update -qq && \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi

configure: deps
	@cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; rm -f build-configure.log; exit 1; }; rm -f build-configure.log

build: configure
	@cmake --build --preset release

# The program and the modules of this mission alone.
demo: configure
	@cmake --build --preset release --target cairn simulated_robot odometry_compass muriel template_matcher \
	  hybrid landmark_search ompl pursuit_dwa behaviours
	$(CAIRN) run config/missions/office.yaml --out out/demo
	$(CAIRN) plan out/demo/office.cairn --from 0.6,0.6 --to "nearest square" --picture out/demo/route.png
	@echo "Look at out/demo/map.png and out/demo/route.png"

test: build
	@cmake --build --preset release --target cairn_tests
	@ctest --test-dir build/release --output-on-failure -j $(JOBS)
	@cmake/test_cases.sh build/release

package: build
	@cmake --build --preset release --target cairn_conformance
	@rm -f build/release/*.deb
	@cd build/release && cpack >package.log 2>&1 || { cat package.log; exit 1; }
	@tests/consumer/package_smoke.sh build/release/cairn_*.deb $$(ls build/release/python3-cairn_*.deb 2>/dev/null)
	@ls -l build/release/*.deb

check: build
	@cmake/check.sh

fuzz: deps
	@cmake/fuzz.sh $(FUZZ)

# Until each reader has had 20 minutes of CPU time, over several evenings.
fuzz-long: deps
	@cmake/fuzz_long.sh $(FUZZ)

bench: build
	@cmake --build --preset release --target cairn_benches
	@build/release/tests/cairn_bench
	@build/release/tests/map_bench
	@build/release/tests/graph_bench
	@build/release/tests/route_bench

experiment: build
	$(CAIRN) experiment config/experiments/first_mission.yaml --out out/first_mission

reference: build
	$(CAIRN) plugins reference --markdown docs/configuration.md --schema-folder config/schema
