#!/bin/sh
# Builds the site of the documents in build/site, from Debian's packages and without a network; a link or a page that is
# missing is an error.
#
#     sh cmake/docs/build.sh
set -eu
cd "$(dirname "$0")/../.."
sh cmake/packages.sh docs
rm -rf build/site
mkdir -p build/site
sphinx-build -q -W --keep-going -b html -c cmake/docs -d build/site/.doctrees . build/site
doxygen cmake/docs/Doxyfile > build/site/.doxygen.log 2>&1
echo '<meta http-equiv="refresh" content="0; url=cmake/docs/index.html">' > build/site/index.html
echo "build/site/index.html"
