// A second serial line at two pins; what arrives goes back as a capital.
#include <SoftwareSerial.h>
SoftwareSerial line(10, 11);

void setup() {
  line.begin(9600);
}

void loop() {
  if (line.available()) line.write(line.read() - 32);
}
