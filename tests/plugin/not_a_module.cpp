// A shared library that is no Cairn module.
extern "C" int unrelated_function() {
  return 42;
}
