#include <Adafruit_BMP085.h>

void setup() {}

void loop() {}
