// stiffness_node: the node that watches a fluidic soft robot; config/stiffness_node.yaml has its parameters.

#include "ros/node_process.h"
#include "ros/stiffness_node.h"

int main(int argc, char** argv) { return live_stiffness::runNode<live_stiffness::StiffnessNode>(argc, argv, "stiffness_node"); }
