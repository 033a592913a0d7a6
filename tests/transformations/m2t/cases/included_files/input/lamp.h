/* One lamp: known to whatever is included behind it. */
static void blink(int pin) {
  high(pin);
  pause(100);
  low(pin);
}
