/* Included, not compiled for itself: so it sees what stands before it. */
static const int left = 5;

void dance(void) {
  blink(left);
  blink(6);
}
