/* One lamp: known to whatever is included behind it. */
static void blink(int32_t pin) {
  high(pin);
  pause(100);
  low(pin);
}
