// What sketches and libraries take of a core, for the core of the Pico that stands in for the real one.
#include <EEPROM.h>
#include <SPI.h>
#include <Servo.h>
#include <SoftwareSerial.h>
#include <Wire.h>
#include <avr/pgmspace.h>
#include <hardware/gpio.h>
#include <hardware/watchdog.h>
#include <pico/time.h>

static_assert(LED_BUILTIN == 25 && NUM_DIGITAL_PINS == 30, "pins");
static_assert(sizeof(int) == 4 && sizeof(long) == 4 && sizeof(void *) == 4 && sizeof(double) == 8, "widths");
static_assert(char(-1) > 0, "plain char is unsigned");

template <class Text> struct Traits;
template <> struct Traits<String> {};
template <> struct Traits<StringSumHelper> {};  // two types, as libraries of JSON have it
String joined(const StringSumHelper &text) { return text + "!"; }

Servo servo;
SoftwareSerial line(2, 3);
repeating_timer_t timer;
const char words[] PROGMEM = "words";
volatile int edges;

void edge() { edges++; }
bool tick(repeating_timer_t *) { return edges < 9; }

void setup() {
  Serial.begin(115200);
  Serial1.begin(9600);
  line.begin(9600);
  pinMode(LED_BUILTIN, OUTPUT);
  servo.attach(5, 544, 2400);
  attachInterrupt(digitalPinToInterrupt(6), edge, CHANGE);
  add_repeating_timer_us(-1000, tick, nullptr, &timer);
  Wire.begin();
  Wire.beginTransmission(0x40);
  Wire.write(1);
  Wire.endTransmission(false);
  Wire.requestFrom(0x40, 2);
  SPI.begin();
  SPI.beginTransaction(SPISettings(1000000, MSBFIRST, SPI_MODE0));
  SPI.transfer(0x55);
  EEPROM.begin(64);
  EEPROM.put(0, 3.5f);
  EEPROM.commit();
  tone(7, 440, 100);
  randomSeed(analogRead(A0));
  watchdog_enable(8000, false);
}

void loop() {
  String text = String(edges) + " of " + random(9) + F(" and ") + String(2.5, 1);
  char number[16];
  dtostrf(analogRead(26) * 3.3 / 1023, 6, 2, number);
  itoa(pulseIn(8, HIGH, 1000), number, 10);
  text.replace("of", "from");
  Serial.println(text.substring(0, 3) + number);
  Serial.println(pgm_read_byte(words), HEX);
  Serial.printf("%s %ld\n", number, millis());
  printf("%f\n", 1.5);
  while (Serial.available()) line.write(Serial.read());
  Serial1.println(line.parseInt());
  servo.write(map(constrain(edges, 0, 9), 0, 9, 0, 180));
  digitalWrite(LED_BUILTIN, edges & 1);
  analogWrite(9, 128);
  gpio_put(10, bitRead(edges, 0));
  watchdog_update();
  noInterrupts();
  interrupts();
  delay(10);
}
