// The EEPROM takes as many bytes as a value has.
#include <EEPROM.h>
#define LIMIT 500
enum Mode : int16_t { OFF, SLOW, FAST };
typedef enum : int16_t { NORTH, SOUTH } Way;
enum Small : uint8_t { NEAR, FAR };
struct __attribute__((packed)) State { Mode mode; byte level; };
struct Config { int16_t speed; float gain; Way way; Small small; };
typedef struct __attribute__((packed)) { byte kind; int16_t x; float turn; } Pose;
Pose pose;
int16_t last = 7;
State state = {FAST, 9};
Config config;
Mode mode = SLOW;
int16_t table[3] = {1, 2, 3};

void setup() { EEPROM.begin(1024);
  EEPROM.put(0, state); EEPROM.commit();
  EEPROM.put(10, mode); EEPROM.commit();
  EEPROM.put(12, (int16_t)(FAST)); EEPROM.commit();
  EEPROM.put(14, config.way); EEPROM.commit();
  EEPROM.put(16, config.speed); EEPROM.commit();
  EEPROM.get(16, config.speed);
  EEPROM.put(18, config.gain); EEPROM.commit();
  EEPROM.put(22, table[1]); EEPROM.commit();
  EEPROM.put(24, (int16_t)(config.speed + 1)); EEPROM.commit();
  EEPROM.put(26, (float)(2.5)); EEPROM.commit();
  EEPROM.put(30, (int16_t)(LIMIT)); EEPROM.commit();
  EEPROM.put(32, (uint16_t)(sizeof(State))); EEPROM.commit();
  EEPROM.put(34, (int16_t)(analogRead(A0))); EEPROM.commit();
  EEPROM.put(36, (byte)7); EEPROM.commit();
  EEPROM.put(37, 'x'); EEPROM.commit();
  EEPROM.put(38, true); EEPROM.commit();
  EEPROM.put(39, 40000); EEPROM.commit();
  EEPROM.put(43, 70000L); EEPROM.commit();
  EEPROM.put(47, last); EEPROM.commit();
  EEPROM.put(47 + sizeof(last), pose); EEPROM.commit();
}

void loop() {
}
