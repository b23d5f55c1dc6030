# Links into the source tree lead nowhere from Doxygen's pages: only their text stays. With -z, for links that are wrapped.
s,!?\[([^]]*)\]\((docs|config|srv|msg|test|include|\.github|CONTRIBUTING|CHANGELOG)[^)]*\),\1,g
