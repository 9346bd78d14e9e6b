int answer_of_missing_library() {
  return 42;
}
