#include <DHT.h>
#include <NobodyKnowsThis.h>
#define SENSOR 2
DHT dht(SENSOR, DHT11);
Unheard thing(5, 6);
const int horn = 4;

void setup() {
  dht.begin();
  pinMode(horn, OUTPUT);
}

void loop() {
  thing.run(dht.readTemperature());
}
