//# header cogload.h
// Machine code of cogs in the EEPROM. Read from propgcc b280e7a77, lib/include/cogload.h.
//# task cognewFromBootEeprom it starts or loads machine code of the Propeller from its EEPROM, which no other microcontroller runs: write what that code does in C
//# task coginitFromBootEeprom it starts or loads machine code of the Propeller from its EEPROM, which no other microcontroller runs: write what that code does in C
//# task readFromBootEeprom it starts or loads machine code of the Propeller from its EEPROM, which no other microcontroller runs: write what that code does in C
//# task writeToBootEeprom it starts or loads machine code of the Propeller from its EEPROM, which no other microcontroller runs: write what that code does in C
//# task COG_IMAGE_EEPROM_OFFSET it starts or loads machine code of the Propeller from its EEPROM, which no other microcontroller runs: write what that code does in C
