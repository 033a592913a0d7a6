// Every name here is the program's own, so that no place is one of the platform.
#define A4 440

struct Bus {
  int eeprom_read_byte(int place) { return place; }
  int tone(int pitch) { return pitch + eeprom_read_byte(1); }
};
const int notes[] = {A4};
Bus bus;

void loop() {
  int servo = notes[0] + bus.tone(A4);
  bus.tone(servo);
}

void setup() {}
