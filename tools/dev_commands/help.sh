# What tools/dev can do.

cat <<'TEXT'
Usage: tools/dev COMMAND [ARGUMENT...]

Every day
  demo        Builds the command, bakes a mesh, casts a million rays and renders a picture.
  check       Builds the runtime and the baker, runs their unit tests, and compiles the single file
              (100 seconds from nothing).
  format      Formats the C and C++ files with clang-format 14; format --check only lists those that differ.
  test        Tests what an ordinary change can break, from the kernels to the installed package (10 to 20 minutes from nothing).
              test --strict fails at a compiler warning, too, as continuous integration does.
  prove       Runs the other tests, in parts, and writes what passed into docs/proven.md:
              prove PART... | --since COMMIT | --all | --drawn | --list
              --since: the parts whose sources differ from the commit's, with --list only their names; --all: three hours;
              --drawn: small_code, or one instruction set, by the hash of the commit, as continuous integration does.
  lint        Runs clang-tidy and cppcheck over lib and tools (10 minutes).
  bench       Measures rays in Espalier and in Embree, Bullet and ODE: bench [OPTION...] MESH...
              bench --help lists the options.
  python      Builds the wheel of the Python package, installs it in build/python/environment, and runs its tests and
              its example (5 minutes from nothing).
  wasm        Builds the npm package in build/wasm/node_modules, and tests it in Node and in a headless Chromium
              (10 minutes from nothing). wasm --bench [--three FOLDER] [--profile NAME] [MESH...] times rays and closest points
              with SIMD128 and without, and against three-mesh-bvh, which FOLDER/node_modules has.
  help        Prints this text.

Before a release
  coverage    Counts which outcomes of conditions in lib/runtime the tests take (7 minutes). Fails below 97 %, or below 100 % for
              open.
  fuzz        Fuzzes each target of fuzz for 60 seconds: fuzz [SECONDS [TARGET...]]. Exit status 1: a finding.
              fuzz --afl uses AFL++ instead of libFuzzer; fuzz --small-code fuzzes the code for microcontrollers;
              fuzz --minimise adds what covers more to fuzz/corpus.
  mutate      Breaks the library in thousands of places, one at a time, and lists the changes that no test finds and no comment
              "// mutant(...)" at the line excuses (an hour):
              mutate [PART...] [--files FILE...] [--since COMMIT] [--survivors] [--claims TEXT...] [--publish]
              A part is one of docs/testing.md or a folder of lib; --since selects the files of lib whose code differs from a
              commit; --publish writes the table of docs/testing.md. Results are kept.
              mutate --sample N [--seed S] [--least SHARE] [--survivors] [--publish] draws N changes at random, and prints which
              share of those that any test finds tools/dev test finds (hours for 600). Exit status 1 below 97 %.
  release     Makes the files of a release in build/packages: Debian packages, checked by lintian, and archives of the
              command for Linux and Windows, which need no packages (10 minutes).
  firmware    Counts code, instructions, bytes read and stack of queries on six emulated Cortex-M cores (3 minutes):
              firmware [FOLDER_OF_MESHES]

Research
  ab          Compares two commits: both answer the same queries in turns within one process. Without --against the other
              side is the working tree: ab [--against COMMIT] COMMIT MESH... [OPTION...]
              A MESH is a file, or torus, terrain, level, small_mesh or tiny_mesh; ab --help lists the options (4 minutes).
  counts      Compares each query with the loop over all triangles, 100,000 times at random and 10,000 times adversarially,
              on generated meshes (10 minutes) and on those of a folder (an hour or two): counts [FOLDER]
  extremes    Casts 10^8 rays at corners and edges of extreme closed meshes, tests a million decisions of the kernels
              against exact arithmetic, and bakes ten million identical triangles: extremes [LIST] (25 minutes).
  guide       Measures everything that docs/guide compares, and writes its tables and figures (20 minutes):
              guide [--part PART] [--name NAME] [MESH...]
              Without a MESH: those of ESPALIER_MESHES or ../shared/meshes, and a house of Debian's assimp-testmodels.
  accuracy    Measures how far blobs of 8 to 20 bits are from their source: accuracy [OPTION...] MESH...

Publishing
  bench [--checkouts FOLDER] --all MACHINE
                                       measures every figure of every page on a quiet machine, and writes bench/results and the
                                       pages (90 minutes once all is built). FOLDER may have checkouts of embree (4),
                                       JoltPhysics, box3d, tinybvh.
  accuracy --publish NAME MESH...      writes bench/results and docs/accuracy.md.
  firmware --publish NAME FOLDER       writes bench/results, docs/small_cores.md and the budgets of tests/firmware.

Missing packages are installed by apt-get, as root or by sudo without a password; otherwise the command to run is printed.
test and prove compile by ccache, where that is installed. All output is in build/, but for docs/proven.md and what --publish and
--minimise write. Files are named from the root of the project, wherever the command is called. Times are of two cores.
Without this script: cmake -B build && cmake --build build --parallel && ctest --test-dir build -LE prove_ -j 4
TEXT
