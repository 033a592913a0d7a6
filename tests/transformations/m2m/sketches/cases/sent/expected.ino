// Arrays are sent and stored as bytes.
#include <EEPROM.h>
typedef struct __attribute__((packed)) { byte kind; int16_t x; } Point;
int16_t values[4];
int16_t rows[2][3];
int16_t kept[3];
int shown[2];
float gains[2];
Point points[2];
int16_t last[2];
char name[8];

void show(int *first) {
  Serial.println(first[0]);
  Serial.write((byte *)first, 4);
}

void send(Point *point) {
  Serial.write((byte *)point, 3);
}

void setup() { EEPROM.begin(1024);
  Serial.begin(9600); while (!Serial && millis() < 3000) {}
  EEPROM.get(0, kept);
  kept[0]++;
  EEPROM.put(0, kept); EEPROM.commit();
  EEPROM.put(6, shown); EEPROM.commit();
  show(shown);
}

void loop() {
  Serial.write((byte *)values, 8);
  Serial.write((byte *)rows[1], sizeof(rows[1]));
  Serial.write((const uint8_t *)gains, sizeof(gains));
  Serial.write((byte *)points, sizeof(points));
  Serial.write((byte *)&last, sizeof(last));
  Serial.write((byte *)name, sizeof(name));
  send(&points[1]);
  int size = sizeof(Point);
  Serial.println(size);
}
