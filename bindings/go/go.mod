module umbilic

go 1.19
