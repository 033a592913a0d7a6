//# header dirent.h
// Folders of a card, as propgcc's file system lists them.
//# task opendir no adapter lists folders yet: open the folder with the library of the card (SD.open of SD.h gives a File)
//# task readdir no adapter lists folders yet: File.openNextFile() of SD.h gives the next entry, its name() is what d_name was
//# task closedir no adapter lists folders yet: File.close() of SD.h
