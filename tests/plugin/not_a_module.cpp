// A shared library that is not a Cairn module.
extern "C" int unrelated_function() {
  return 42;
}
