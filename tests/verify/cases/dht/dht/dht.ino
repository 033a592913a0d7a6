#include <DHT.h>

DHT sensor(2, DHT22);

void setup() {
  Serial.begin(9600);
  sensor.begin();
}

void loop() {
  const float humidity = sensor.readHumidity();
  const float celsius = sensor.readTemperature();
  const float fahrenheit = sensor.readTemperature(true);
  if (isnan(humidity) || isnan(celsius)) return;
  Serial.println(sensor.computeHeatIndex(celsius, humidity, false));
  Serial.println(sensor.computeHeatIndex(fahrenheit, humidity));
  delay(2000);
}
