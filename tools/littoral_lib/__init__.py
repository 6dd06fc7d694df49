"""What stands behind tools/littoral: launching, collecting, checking, pictures, verification."""
