int part(void) {
  us++; // told
  return us;
}
