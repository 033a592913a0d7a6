/* Included, not compiled for itself: so it sees what stands before it. */
static const int32_t left = 2;

void dance(void) {
  blink(left);
  blink(3);
}
