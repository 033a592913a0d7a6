int part(void) {
  _clkfreq++; // told
  return _clkfreq;
}
