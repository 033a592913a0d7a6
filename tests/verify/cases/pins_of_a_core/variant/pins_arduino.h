// The forms in which cores write the numbers of pins; D3 and A2 are not the board's, D4 is not told.
#define PIN_D13   (6u)
static const uint8_t D2 = (25u);
static const uint8_t D3 = (16u);    // D4's
const uint8_t A0 = 0x1A;
static const uint8_t A1 = PIN_A1;
constexpr uint8_t A2 = 29;
#ifdef OTHER
#define D4 (17u)
#else
#define D4 (18u)
#endif
#define LED_BUILTIN PIN_LED
#include "../shared.h"
