// The EEPROM takes as many bytes as a value has.
#include <EEPROM.h>
#define LIMIT 500
enum Mode { OFF, SLOW, FAST };
typedef enum { NORTH, SOUTH } Way;
enum Small : uint8_t { NEAR, FAR };
struct State { Mode mode; byte level; };
struct Config { int speed; double gain; Way way; Small small; };
typedef struct { byte kind; int x; double turn; } Pose;
Pose pose;
int last = 7;
State state = {FAST, 9};
Config config;
Mode mode = SLOW;
int table[3] = {1, 2, 3};

void setup() {
  EEPROM.put(0, state);
  EEPROM.put(10, mode);
  EEPROM.put(12, FAST);
  EEPROM.put(14, config.way);
  EEPROM.put(16, config.speed);
  EEPROM.get(16, config.speed);
  EEPROM.put(18, config.gain);
  EEPROM.put(22, table[1]);
  EEPROM.put(24, config.speed + 1);
  EEPROM.put(26, 2.5);
  EEPROM.put(30, LIMIT);
  EEPROM.put(32, sizeof(State));
  EEPROM.put(34, analogRead(A0));
  EEPROM.put(36, (byte)7);
  EEPROM.put(37, 'x');
  EEPROM.put(38, true);
  EEPROM.put(39, 40000);
  EEPROM.put(43, 70000L);
  EEPROM.put(47, last);
  EEPROM.put(47 + sizeof(last), pose);
}

void loop() {
}
