#include <SPI.h>
int square(int side) { return side * side; }
void setup() {
  Serial3.begin(9600);
  SPI.setClockDivider(SPI_CLOCK_DIV16);
  if (digitalPinHasPWM(5)) analogWrite(5, square(3));
}
void loop() {
#if defined(__AVR_ATmega2560__)
  delay(10);
#else
#error "no such board"
#endif
}
