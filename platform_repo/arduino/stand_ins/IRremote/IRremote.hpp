// Stand-in with the API of Arduino-IRremote 4. Own code, after the description of the NEC protocol.
#ifndef IRREMOTE_HPP
#define IRREMOTE_HPP

#include <Arduino.h>

#define ENABLE_LED_FEEDBACK true
#define DISABLE_LED_FEEDBACK false
#define IRDATA_FLAGS_EMPTY 0x00
#define IRDATA_FLAGS_IS_REPEAT 0x01

enum decode_type_t { UNKNOWN = 0, NEC = 8 };

struct IRData {
  decode_type_t protocol;
  uint16_t address;
  uint16_t command;
  uint16_t extra;
  uint8_t numberOfBits;
  uint8_t flags;
  uint32_t decodedRawData;  // the first bit received is the lowest
};

class IRrecv {
 public:
  IRrecv();
  explicit IRrecv(uint8_t pin);
  void begin(uint8_t pin, bool feedback = false, uint8_t feedbackPin = 0);  // feedback: for compatibility, not used
  void enableIRIn();
  void disableIRIn();
  void start() { enableIRIn(); }
  void stop() { disableIRIn(); }
  bool decode();     // true when a frame is there; it stays until resume()
  void resume();     // wait for the next frame
  bool available() { return decode(); }
  bool isIdle();
  bool printIRResultShort(Print *out);

  IRData decodedIRData;

 private:
  uint8_t pin;
};

class IRsend {
 public:
  IRsend();
  explicit IRsend(uint8_t pin);
  void begin(uint8_t pin);
  void sendNEC(uint16_t address, uint16_t command, int_fast8_t repeats = 0);

 private:
  void mark(uint16_t microseconds);
  void space(uint16_t microseconds);

  uint8_t pin;
};

extern IRrecv IrReceiver;
extern IRsend IrSender;

#endif
